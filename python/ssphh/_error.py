"""The exception of the library."""


class Error(Exception):
    """Bad input, or something around the program that fails.

    where: file and place, argument or object at fault. problem: what is wrong. hint: what to do about it, or "".
    str() reads "WHERE: PROBLEM (HINT)".
    """

    def __init__(self, where, problem, hint=""):
        super().__init__(where, problem, hint)
        self.where = where
        self.problem = problem
        self.hint = hint

    def __str__(self):
        return f"{self.where}: {self.problem}" + (f" ({self.hint})" if self.hint else "")


Error.__module__ = "ssphh"
