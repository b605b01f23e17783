"""The error that everything raises."""

class Error(Exception):
    """Bad input, or something around the program that fails; str() reads "WHERE: PROBLEM (HINT)"."""

    where: str
    problem: str
    hint: str
    def __init__(self, where: str, problem: str, hint: str = "") -> None: ...
