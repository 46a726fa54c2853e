# The extension, for the package's own files; __init__.pyi has the types of what it gives to users.
from typing import Any

def __getattr__(name: str) -> Any: ...
