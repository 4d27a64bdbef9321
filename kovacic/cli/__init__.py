"""The command `kovacic`: arguments go in, answers on standard output and an exit status come out.

One module a subcommand, imported when it is called; `main` is the entry point (read it first), `options` what several
commands have in common, `many` what the commands for thousands of equations have in common.
"""
