"""This file answers one SMT-LIB 2 question from standard input with bitwuzla: its verdict, and the bits of the unknowns named after it."""
import sys

import bitwuzla

question, _, unknowns = sys.stdin.read().partition("(check-sat)\n")
parser = bitwuzla.Parser(bitwuzla.TermManager(), bitwuzla.Options())
parser.parse(question, True, False)
solver = parser.bitwuzla()
verdict = solver.check_sat()
print(verdict.name)
if verdict == bitwuzla.Result.SAT:
    for name in unknowns.split():
        print(solver.get_value(parser.parse_term(name)).value(2))
