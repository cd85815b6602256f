"""`python -m tissu`: the same as the command `tissu`."""

from tissu.cli import main

main()
