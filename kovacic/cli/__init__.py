"""The command `kovacic`: one module a subcommand, imported when it is called."""
