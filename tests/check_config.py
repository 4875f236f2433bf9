"""Check config/config.yaml alone and with every other file of config/ and examples/ on top, as a build would."""

import sys
from pathlib import Path

import yaml

from granugas.configuration import ConfigError, merged
from granugas.declared import studies_in
from granugas.studies import load

ROOT = Path(__file__).parents[1]


def main() -> int:
    """1 where a file is not as the schema and the studies ask for; the message says which, the key and what is allowed."""
    schema = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text(encoding="utf-8"))
    base = ROOT / "config/config.yaml"
    figures, wrong = studies_in(ROOT / "workflow/figures"), 0
    for overlay in sorted({*ROOT.glob("config/*.yaml"), *ROOT.glob("examples/*.yaml")}):
        try:
            load(merged(dict.fromkeys((base, overlay))), schema, figures)
        except ConfigError as error:
            print(f"{overlay.relative_to(ROOT)}: {error}")
            wrong = 1
    return wrong


if __name__ == "__main__":
    sys.exit(main())
