"""``python -m etot_cli`` does what ``etot`` does."""

from etot_cli.cli.app import main

main()
