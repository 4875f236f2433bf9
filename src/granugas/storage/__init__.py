"""Datasets on disk: one table of variables, files that describe themselves, runs pooled into studies."""
