"""The command `kovacic`: arguments go in, answers on standard output and an exit status come out.

`main` is the entry point (read it first), with the table of the subcommands; their modules are imported when they are called.
`equations` and `values` treat one equation, `many` thousands, `ball` the rolling ball; `options` has what they share.
"""
