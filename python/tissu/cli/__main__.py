"""`python -m tissu.cli`: the same as the command `tissu`."""

from tissu.cli import main

main()
