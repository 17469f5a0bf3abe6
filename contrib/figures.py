#!/usr/bin/env python3
"""Figures about the structure of the code, read from the sources of a checkout. Needs Python 3.9 and nothing else.

    contrib/figures.py                        a table of all figures
    contrib/figures.py --list names           the offenders behind one figure, with file and line
    contrib/figures.py --repo DIR             of another checkout, for comparing two
    contrib/figures.py --under src/ui ...     of a part of the sources only

Figures: production lines (tests left out), functions and their lengths, type names that are declared more than
once, tuple parameters, a `let` that shadows the one right before it, doc comments of three words or fewer, and
modules of one parent that depend on each other in a circle.
"""

import argparse
import pathlib
import re
import sys
from collections import defaultdict

TYPE = re.compile(r"^\s*(?:pub(?:\([^)]*\))?\s+)?(?:struct|enum|trait|union|type)\s+([A-Z]\w*)", re.M)
FUNCTION = re.compile(r"\bfn\s+(\w+)")
INLINE_TESTS = re.compile(r"#\[cfg\(test\)\]\s*(?:pub(?:\([^)]*\))?\s+)?mod\s+\w+\s*\{")
TEST_FILES = {"tests", "testing", "fake"}
LISTS = ["names", "tuples", "shadows", "docs", "cycles", "long"]


class Source:
    """One file: its code with comments, strings and tests blanked out, at the same places as in the file."""

    def __init__(self, root, path):
        self.path = path.relative_to(root)
        text = path.read_text(encoding="utf-8")
        clean = blanked(text)
        for match in list(INLINE_TESTS.finditer(clean)):
            end = closing(clean, match.end() - 1)
            clean = blank_out(clean, match.start(), end)
            text = blank_out(text, match.start(), end)
        self.text = text
        self.code = clean

    def line(self, offset):
        return self.text.count("\n", 0, offset) + 1

    def at(self, offset):
        return f"{self.path}:{self.line(offset)}"


def blank_out(text, start, end):
    middle = re.sub(r"[^\n]", " ", text[start:end])
    return text[:start] + middle + text[end:]


TOKEN = re.compile(
    r"//[^\n]*|/\*.*?\*/|b?r(#*)\".*?\"\1|b?\"(?:\\.|[^\"\\])*\"|b?'(?:\\(?:x..|u\{[^}]*\}|.)|[^'\\\n])'",
    re.S,
)


def blanked(text):
    """The code without what comments and literals say; every character keeps its place."""
    return TOKEN.sub(lambda match: re.sub(r"[^\n]", " ", match.group(0)), text)


def closing(code, opening):
    """The place right after the bracket that closes the one at `opening`."""
    pairs = {"(": ")", "{": "}", "[": "]"}
    depth, opener, closer = 0, code[opening], pairs[code[opening]]
    for at in range(opening, len(code)):
        if code[at] == opener:
            depth += 1
        elif code[at] == closer:
            depth -= 1
            if depth == 0:
                return at + 1
    return len(code)


def is_test(path):
    return any(part in TEST_FILES for part in (*path.parent.parts, path.stem))


def sources(root, under):
    folders = [root / "src", *sorted((root / "crates").glob("*/src"))]
    for folder in folders:
        for path in sorted(folder.rglob("*.rs")):
            inner = path.relative_to(root)
            wanted = not under or any(str(inner).startswith(part.rstrip("/")) for part in under)
            if wanted and not is_test(path.relative_to(folder)):
                yield Source(root, path)


def functions(source):
    """Name, parameters, offset and number of lines of each function with a body."""
    code = source.code
    for match in FUNCTION.finditer(code):
        opening = code.find("(", match.end())
        if opening < 0:
            continue
        between = code[match.end() : opening]
        if "<" in between:  # generic parameters may hold brackets of their own, as in `F: Fn(u8)`
            opening = after_generics(code, match.end())
        end = closing(code, opening)
        body = re.compile(r"[{;]").search(code, end)
        if body is None:
            continue
        lines = 0
        if body.group(0) == "{":
            lines = source.line(closing(code, body.start())) - source.line(match.start()) + 1
        yield match.group(1), code[opening + 1 : end - 1], match.start(), lines


def after_generics(code, at):
    depth = 0
    while at < len(code):
        if code[at] == "<":
            depth += 1
        elif code[at] == ">" and code[at - 1] != "-":
            depth -= 1
        elif code[at] == "(" and depth == 0:
            return at
        at += 1
    return at


def parameters(text):
    """The parameters of a list, split at its outermost commas."""
    depth, start = 0, 0
    for at, character in enumerate(text):
        if character in "([{<":
            depth += 1
        elif character in ")]}" or (character == ">" and text[at - 1] != "-"):
            depth -= 1
        elif character == "," and depth == 0:
            yield text[start:at].strip()
            start = at + 1
    yield text[start:].strip()


def is_tuple(parameter):
    pattern, colon, kind = parameter.partition(":")
    if parameter.startswith("("):
        inner = parameter[1 : closing(parameter, 0) - 1]
        return len([part for part in parameters(inner) if part]) > 1
    kind = re.sub(r"^\s*&?\s*('\w+\s+)?(mut\s+)?", "", kind) if colon else ""
    if not kind.startswith("("):
        return False
    inner = kind[1 : closing(kind, 0) - 1]
    return len([part for part in parameters(inner) if part]) > 1


LET = re.compile(r"\blet\s+(?:mut\s+)?([a-z_]\w*)\s*(?::[^=;]+)?=(?!=)")


def shadows(source):
    """Each `let` that takes the name of the `let` statement right before it and uses its value."""
    code, last = source.code, None
    for match in LET.finditer(code):
        end = statement_end(code, match.end())
        name = match.group(1)
        follows = last is not None and last[0] == name and not code[last[1] : match.start()].strip()
        if follows and re.search(rf"\b{name}\b", code[match.end() : end]):
            yield match.start(), name
        last = (name, end)


def statement_end(code, at):
    depth = 0
    while at < len(code):
        character = code[at]
        if character in "([{":
            depth += 1
        elif character in ")]}":
            depth -= 1
            if depth < 0:
                return at
        elif character == ";" and depth == 0:
            return at + 1
        at += 1
    return at


def short_docs(source):
    """Each doc comment of three words or fewer."""
    block, start = [], 0
    for number, line in enumerate([*source.text.split("\n"), ""], 1):
        text = line.strip()
        if text.startswith("///"):
            if not block:
                start = number
            block.append(text[3:].strip())
        elif block:
            if len(" ".join(block).split()) <= 3:
                yield start, " ".join(block)
            block = []


def module(root, source):
    """The crate and the path of modules of a file: ("sortie", ["ui", "widget", "swarm"])."""
    parts = list(source.path.parts)
    if parts[0] == "crates":
        crate, inner = parts[1], parts[3:]
    else:
        crate, inner = "sortie", parts[1:]
    inner[-1] = inner[-1].removesuffix(".rs")
    return crate, [] if inner in (["lib"], ["main"]) else inner


def paths_used(code):
    """Every path that begins with crate, self or super, groups taken apart: ["super", "super", "room", "map"]."""
    for match in re.finditer(r"\b(?:crate|super|self)(?:::\w+)*(?:::\{)?", code):
        text = match.group(0)
        if match.start() and (code[match.start() - 1] in "_(" and text in ("crate", "super", "self")):
            continue
        if text.endswith("::{"):
            opening = match.end() - 1
            inner = code[opening + 1 : closing(code, opening) - 1]
            for tail in group(inner):
                yield text[:-3].split("::") + tail
        else:
            yield text.split("::")


def group(text):
    for part in parameters(text):
        opening = part.find("{")
        if opening >= 0:
            head = [word for word in part[:opening].split("::") if word.strip()]
            for tail in group(part[opening + 1 : closing(part, opening) - 1]):
                yield [word.strip() for word in head] + tail
        elif part:
            yield [word.strip() for word in re.split(r"::|\s+as\s+", part)]


def edges(root, files):
    """For each parent module, which of its children use which."""
    known = {tuple([crate, *path]) for crate, path in (module(root, source) for source in files)}
    for full in list(known):
        for length in range(1, len(full)):
            known.add(full[:length])
    found = defaultdict(lambda: defaultdict(set))
    for source in files:
        crate, here = module(root, source)
        for path in paths_used(source.code):
            target = resolve(here, path)
            if target is None:
                continue
            while target and tuple([crate, *target]) not in known:
                target = target[:-1]
            common = 0
            while common < min(len(here), len(target)) and here[common] == target[common]:
                common += 1
            if common < len(here) and common < len(target):
                parent = "::".join([crate, *here[:common]])
                found[parent][here[common]].add(target[common])
    return found


def resolve(here, path):
    if path[0] == "crate":
        return path[1:]
    at = list(here)
    while path and path[0] in ("super", "self"):
        if path[0] == "super":
            if not at:
                return None
            at = at[:-1]
        path = path[1:]
    return at + path


def components(graph):
    """Groups of more than one module that depend on each other (Tarjan)."""
    index, low, stack, on_stack, found = {}, {}, [], set(), []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        on_stack.add(node)
        for other in sorted(graph.get(node, ())):
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in on_stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            group = []
            while True:
                other = stack.pop()
                on_stack.discard(other)
                group.append(other)
                if other == node:
                    break
            if len(group) > 1:
                found.append(sorted(group))

    for node in sorted(graph):
        if node not in index:
            visit(node)
    return found


def measure(root, files):
    figures, lists = {}, {name: [] for name in LISTS}
    lines = sum(sum(1 for line in source.text.split("\n") if line.strip()) for source in files)
    figures["production lines (not blank)"] = lines
    figures["production files"] = len(files)

    declared = defaultdict(list)
    lengths, tuples = [], 0
    for source in files:
        for match in TYPE.finditer(source.code):
            # Associated types (`type Err = ...` in an impl) are indented and declare no name of their own.
            indented = match.group(0).lstrip("\n").startswith(" ")
            if not (indented and re.search(r"\btype\b", match.group(0))):
                declared[match.group(1)].append(source.at(match.start(1)))
        for name, arguments, offset, length in functions(source):
            if length:
                lengths.append(length)
                if length > 40:
                    lists["long"].append(f"{source.at(offset)}: {name}, {length} lines")
            bad = [parameter for parameter in parameters(arguments) if is_tuple(parameter)]
            if bad:
                tuples += 1
                shown = "; ".join(" ".join(parameter.split()) for parameter in bad)
                lists["tuples"].append(f"{source.at(offset)}: {name}({shown})")
        lists["shadows"] += [f"{source.at(offset)}: {name}" for offset, name in shadows(source)]
        lists["docs"] += [f"{source.path}:{line}: {text}" for line, text in short_docs(source)]

    total = sum(len(places) for places in declared.values())
    shared = {name: places for name, places in declared.items() if len(places) > 1}
    sharing = sum(len(places) for places in shared.values())
    for name, places in sorted(shared.items(), key=lambda item: (-len(item[1]), item[0])):
        lists["names"].append(f"{name}: {', '.join(places)}")
    lengths.sort()
    figures["functions"] = len(lengths)
    figures["functions of over 40 lines"] = sum(1 for length in lengths if length > 40)
    figures["longest function"] = lengths[-1] if lengths else 0
    figures["type names declared"] = total
    figures["of them sharing a name"] = sharing
    figures["share of shared type names, percent"] = round(100 * sharing / max(total, 1), 1)
    figures["functions with tuple parameters"] = tuples
    figures["lets that shadow the one before"] = len(lists["shadows"])
    figures["doc comments of three words or fewer"] = len(lists["docs"])

    in_cycles = 0
    for parent, graph in sorted(edges(root, files).items()):
        for group_ in components(graph):
            in_cycles += len(group_)
            lists["cycles"].append(f"{parent}: {', '.join(group_)}")
            for user in group_:
                used = sorted(set(graph[user]) & set(group_))
                lists["cycles"].append(f"    {user} -> {', '.join(used)}")
    figures["modules in a cycle"] = in_cycles
    return figures, lists


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repo", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--list", choices=LISTS)
    parser.add_argument("--under", nargs="+", default=[])
    options = parser.parse_args()
    root = options.repo.resolve()
    # Names are shared, and cycles exist, across the whole of the sources: a part is only a filter on what is listed.
    files = list(sources(root, []))
    if not files:
        sys.exit(f"{root} has no src/*.rs: name a checkout with --repo")
    part = list(sources(root, options.under)) if options.under else files
    if options.list in ("names", "cycles"):
        _, lists = measure(root, files)
        rows = lists[options.list]
        if options.under:
            rows = [row for row in rows if any(place in row for place in options.under)]
    elif options.list:
        _, lists = measure(root, part)
        rows = lists[options.list]
    else:
        figures, _ = measure(root, part)
        rows = [f"{value:>10}  {name}" for name, value in figures.items()]
    print("\n".join(rows))


if __name__ == "__main__":
    main()
