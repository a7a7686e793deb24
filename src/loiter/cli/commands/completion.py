"""`loiter completion`: a script with which a shell completes commands and options."""

import sys
from typing import Literal


def completion(shell: Literal["bash", "zsh", "fish"], /) -> None:
    """Print a completion script: `eval "$(loiter completion bash)"`.

    Parameters
    ----------
    shell
        The shell for which the script completes commands and options.
    """
    from loiter.cli.app import app

    sys.stdout.write(app.generate_completion(shell=shell))
