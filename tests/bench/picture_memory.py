"""What reprise-render has in its environment, for those who measure pictures: cli/process/picture_memory.h says why."""
import re
from pathlib import Path

HEADER = Path(__file__).resolve().parents[2] / "cli/process/picture_memory.h"


def environment():
    """{"GLIBC_TUNABLES": ...}, as the header has it."""
    words = re.search(r"picture_memory =([^;]*);", HEADER.read_text()).group(1)
    return {"GLIBC_TUNABLES": "".join(re.findall(r'"([^"]*)"', words))}


if __name__ == "__main__":
    print(*(f"{key}={value}" for key, value in environment().items()))
