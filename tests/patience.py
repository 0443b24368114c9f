"""Lengthens limits of elapsed time by the machine's load, as tests/page/patience.mjs does."""
import os

MOST = 4  # A late end must not pass as a busy machine.

def patience():
    """Returns the factor for a limit; the limit is that of an idle machine."""
    return min(MOST, max(1, os.getloadavg()[0] / os.cpu_count()))
