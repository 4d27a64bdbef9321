"""The command `kovacic`: arguments go in, answers on standard output and an exit status come out.

`main` is the entry point (read it first), with the table of the subcommands; their modules are imported when they are called.
`answer` and `values` treat an equation, `many` thousands, `ball` the rolling ball; `options` is what several of them share.
"""
