"""Answers Dakota's parameters files by one `rollres serve`: driver.py SCENE [KEY=VALUE]... PARAMETERS RESULTS

The file is of Dakota's standard format, with one set of parameters or, in batch mode, many. Dakota's fork interface adds
the last two words. A point without an answer is FAIL; derivatives are Dakota's own (numerical_gradients).
"""

import json
import subprocess
import sys

scene, *overrides, parameters, results = sys.argv[1:]


def read_sets(lines):
    """(inputs, names of responses) of each set: counts with what they count behind them."""
    words = [line.split() for line in lines if line.strip()]
    while words:
        count = int(words.pop(0)[0])
        inputs = {name: float(value) for value, name in words[:count]}
        del words[:count]
        count = int(words.pop(0)[0])
        responses = [label.split(":", 1)[1] if active == "1" else None for active, label in words[:count]]
        while words and words[0][1] != "variables":  # derivative variables, analysis components, metadata, the number
            words.pop(0)
        yield inputs, responses


def number_or_text(word):
    try:
        return float(word)
    except ValueError:
        return word


def text_of(answer, responses):
    values = [answer.get(name) for name in responses]
    if answer.get("status") != "converged" or None in values:
        return "FAIL\n"
    return "".join(f"{value!r} {name}\n" for value, name in zip(values, responses))


with open(parameters, encoding="utf-8") as file:
    sets = list(read_sets(file))
given = {key: number_or_text(value) for key, value in (word.split("=", 1) for word in overrides)}
questions = "".join(json.dumps({**given, **inputs}) + "\n" for inputs, _ in sets)
served = subprocess.run(["rollres", "serve", scene], input=questions, stdout=subprocess.PIPE, text=True, check=True)
answers = [json.loads(line) for line in served.stdout.splitlines()]
with open(results, "w", encoding="utf-8") as file:
    file.write("#\n".join(text_of(answer, responses) for answer, (_, responses) in zip(answers, sets)))
