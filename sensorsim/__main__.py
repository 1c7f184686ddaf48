"""`python -m sensorsim`."""

from sensorsim.cli import main

main()
