"""`kovacic schema`: the JSON Schema of every line of JSON that a command prints."""

from __future__ import annotations

import pkgutil

import click


@click.command()
def command() -> None:
    """Print the JSON Schema that describes every line that solve, batch, scan, conditions and ball print with --json.

    \b
    kovacic schema > schema.json
    """
    schema = pkgutil.get_data("kovacic.views", "schema.json")
    assert schema is not None
    click.echo(schema.decode("utf-8"), nl=False)
