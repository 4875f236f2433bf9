"""The documentation site: `make docs`. Nothing in its pages is loaded from elsewhere."""

import logging
import os
import sys
from pathlib import Path

EXTENSIONS = Path(__file__).parent / "extensions"
sys.path.insert(0, str(EXTENSIONS))
os.environ["JUPYTER_PATH"] = str(EXTENSIONS / "jupyter")  # the notebook runs in this Python, whatever kernels its user has
os.environ.pop("MPLBACKEND", None)  # its figures belong into the page

project = "granugas"
author = "The granugas developers"
copyright = "The granugas developers, BSD-3-Clause"

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "mathml", "generated", "plain_docstrings"]
exclude_patterns = ["_build", "**.ipynb_checkpoints"]

html_theme = "furo"
html_title = "granugas"
html_static_path = ["_static", "../results/gallery/cluster1999_growth.mp4"]
html_css_files = ["granugas.css"]
html_math_renderer = "mathml"
html_copy_source = False
html_show_sphinx = False

myst_enable_extensions = ["dollarmath", "amsmath", "deflist", "colon_fence"]
myst_heading_anchors = 3

nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_in_temp = True
nb_execution_timeout = 300
nb_execution_show_tb = True
nb_merge_streams = True

default_role = "literal"
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
napoleon_use_ivar = True
napoleon_attr_annotations = False  # types stand in the signature
python_maximum_signature_line_length = 90

logging.getLogger("traitlets").setLevel(logging.WARNING)  # not a word of the notebook's start
