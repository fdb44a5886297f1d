#!/usr/bin/env python3
"""Runs the tests on every mutant that cargo-mutants lists, in a single build.

    .ci/mutants [--room ROOM]… [--changed COMMIT] [--sample N] [--shard I/N] [--slowest S] [--most S] [--seconds S] [--least P]
        [--jobs N] DIR

cargo-mutants builds the tests again for each mutant. A build takes half a minute or more, and there are thousands of mutants.
This script builds all mutants at once. Each mutated expression calls `mutants::active(NUMBER)`, which returns whether the
environment variable MUTANT is NUMBER. A first run of each test records the mutants that it reaches. Then the script runs the
tests that reach a mutant, cheap and promising ones first, until one fails. A mutant that does not compile is left out
("unviable"), as in cargo-mutants.

DIR contains the instrumented copy, its build and all results. A second run continues the first one. With a larger --most or
--slowest, a second run also tests the unlisted survivors further, with more tests. `.ci/mutants.survivors` lists the mutants
that no test kills, one on each line with the reason. The script fails if an unlisted mutant survives, or if a listed one is
killed. With --least it fails only if too few mutants have the expected result.

Examples in the documentation (doctests) are not run.

Needs cargo-mutants, which lists the faults, and the Python packages tree-sitter and tree-sitter-rust. `.ci/mutants`
installs them. """

import argparse
import collections
import concurrent.futures
import json
import math
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import tree_sitter
import tree_sitter_rust

HERE = Path(__file__).parent.parent
SURVIVORS = HERE / ".ci" / "mutants.survivors"
# Crates, modules and files that only read, write, draw, or generate test inputs. They compute no results, so they are left out.
TOOLS = {"arbitrary", "cli", "data", "dem", "figure", "testing"}
RECORDS = {
    "crates/disorder/src/ensemble/record.rs",
    "crates/horizontal/src/certificate/file.rs",
    "crates/horizontal/src/certificate/record.rs",
}
# The unpublished crate with test tools is left out, too.
TESTKIT = "cannonpile-testkit"
# The sources of all crates, for git.
SOURCES = ["src", "crates/*/src/*"]
# The outcomes of a mutant that no test kills.
UNNOTICED = ["survives", "survives so far", "not reached"]
PARSER = tree_sitter.Parser(tree_sitter.Language(tree_sitter_rust.language()))

# The module that mutated code calls. No mutant is active in constant evaluation. So a constant with mutants also becomes a
# function, which expressions in its file or block call. Other files, macros, patterns and paths use the original constant.
ACTIVE_MODULE = """
//! The active mutant: the one that the environment variable MUTANT names, or none.
use core::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};
use std::io::Write;

const UNKNOWN: u32 = u32::MAX;
const RECORD: u32 = u32::MAX - 1;
const NONE: u32 = u32::MAX - 2;
static PLANTED: AtomicU32 = AtomicU32::new(UNKNOWN);
static SEEN: [AtomicBool; COUNT] = [const { AtomicBool::new(false) }; COUNT];

/// Returns whether this mutant is active.
#[inline]
pub const fn active(fault: u32) -> bool {
    core::intrinsics::const_eval_select((fault,), never, now)
}
const fn never(_: u32) -> bool {
    false
}
#[inline]
fn now(fault: u32) -> bool {
    let planted = PLANTED.load(Relaxed);
    planted == fault || planted >= RECORD && first(fault, planted)
}
#[cold]
#[inline(never)]
fn first(fault: u32, planted: u32) -> bool {
    let record = std::env::var_os("MUTANTS_REACHED");
    if planted == UNKNOWN {
        let named = std::env::var("MUTANT").ok().and_then(|name| name.parse().ok());
        let planted = named.unwrap_or(if record.is_some() { RECORD } else { NONE });
        PLANTED.store(planted, Relaxed);
        return now(fault);
    }
    if !SEEN[fault as usize].swap(true, Relaxed) {
        let path = record.expect("it was there");
        let mut file = std::fs::OpenOptions::new().append(true).create(true).open(path).expect("a file");
        file.write_all(format!("{fault}\\n").as_bytes()).expect("room");
    }
    false
}

/// The return value of a function with the return type `impl Iterator`: from a mutant, or from the original body.
pub enum Either<A, B> {
    Planted(A),
    Own(B),
}
impl<A: Iterator<Item = B::Item>, B: Iterator> Iterator for Either<A, B> {
    type Item = B::Item;
    fn next(&mut self) -> Option<B::Item> {
        match self {
            Self::Planted(all) => all.next(),
            Self::Own(all) => all.next(),
        }
    }
    fn size_hint(&self) -> (usize, Option<usize>) {
        match self {
            Self::Planted(all) => all.size_hint(),
            Self::Own(all) => all.size_hint(),
        }
    }
}
"""


def room(file):
    """Returns the name of the crate that contains a file, or of the module if the file is in the main crate."""
    return Path(file).parts[1].removesuffix(".rs")


def path_to_questions(file):
    """Returns the crate in the path of the module `mutants`, which is in `exact-surd` and re-exported by `cannonpile`."""
    return "crate" if file.startswith(("src/", "crates/surd/")) else "cannonpile"


class Fault:
    """A mutant of cargo-mutants, with its position in the file."""

    def __init__(self, number, listed, text):
        self.number = number
        self.file = listed["file"]
        self.genre = listed["genre"]
        self.replacement = listed["replacement"]
        place, _, self.words = listed["name"].partition(": ")
        self.place = place
        lines = text.split("\n")
        start = listed["span"]["start"]
        line = lines[start["line"] - 1]
        self.at = len("\n".join(lines[: start["line"] - 1]).encode()) + (start["line"] > 1)
        self.at += len(line[: start["column"] - 1].encode())
        # The key contains no line number, because unrelated edits would change it.
        self.key = f"{self.file}: {self.words}: {line.strip()}"


def enclosing_node(node, kinds):
    while node is not None and node.type not in kinds:
        node = node.parent
    return node


class Rewriter:
    """Rewrites one file with all remaining mutants."""

    def __init__(self, source, faults, path):
        self.source = source
        self.path = path
        self.by_node = collections.defaultdict(list)
        self.apart = []
        # Constants with mutants, by node and by name.
        self.constants = {}
        tree = PARSER.parse(source)
        self.root = tree.root_node
        for fault in faults:
            node = self.node_of(fault)
            if node is None:
                self.apart.append(fault)
            else:
                self.by_node[node.id].append(fault)
                self.note_constant(node)

    def note_constant(self, node):
        """Records the constant that contains an expression, unless the constant is in an `impl`, a trait or an inline module."""
        item = enclosing_node(node, {"const_item"})
        if item is not None and item.parent.type in {"source_file", "block"}:
            self.constants[item.id] = (item.child_by_field_name("name").text, item, item.parent)

    def constant_read(self, node):
        """Returns a call of the function that replaces a constant, if an identifier names a constant with mutants."""
        for name, item, scope in self.constants.values():
            if node.text == name and scope.start_byte <= node.start_byte < scope.end_byte and enclosing_node(
                node, {"match_pattern", "use_declaration", "token_tree", "scoped_identifier", "shorthand_field_initializer"}
            ) is None and node != item.child_by_field_name("name"):
                return f"planted_{name.decode()}()"
        return None

    def node_of(self, fault):
        leaf = self.root.descendant_for_byte_range(fault.at, fault.at)
        kinds = {
            "BinaryOperator": {"binary_expression", "compound_assignment_expr"},
            "UnaryOperator": {"unary_expression"},
            "MatchArm": {"match_arm"},
            "MatchArmGuard": {"match_pattern"},
            "StructField": {"struct_expression"},
            "FnValue": {"function_item"},
        }[fault.genre]
        node = leaf
        while node is not None and node.type not in kinds:
            if fault.genre == "BinaryOperator" and node.type in {"let_chain", "block"}:
                return None
            node = node.parent
        return node

    def whole(self):
        return self.text(self.root)

    def slice(self, start, end):
        return self.source[start:end].decode()

    def text(self, node):
        if node.id in self.constants:
            return self.slice(node.start_byte, node.end_byte) + self.as_function(node)
        faults = self.by_node.get(node.id)
        if faults:
            return f"/*<{','.join(str(f.number) for f in faults)}*/{self.changed(node, faults)}/*>*/"
        return self.plain(node)

    def plain(self, node, changed=()):
        """Returns the text of a node, with replacements for some children."""
        if node.child_count == 0:
            read = self.constant_read(node) if node.type == "identifier" else None
            return read or self.slice(node.start_byte, node.end_byte)
        parts, at = [], node.start_byte
        given = {child.id: text for child, text in changed}
        for child in node.children:
            parts.append(self.slice(at, child.start_byte))
            parts.append(given[child.id] if child.id in given else self.text(child))
            at = child.end_byte
        parts.append(self.slice(at, node.end_byte))
        return "".join(parts)

    def as_function(self, item):
        """Returns a function with the value of a constant and its mutants."""
        name, kind, value = (item.child_by_field_name(field) for field in ("name", "type", "value"))
        return f" const fn planted_{name.text.decode()}() -> {self.plain(kind)} {{ {self.text(value)} }}"

    def active(self, fault):
        return f"{self.path}::mutants::active({fault.number})"

    def choice(self, faults, original, alternative):
        """Returns a chain of `if` and `else`. Marks around each alternative show which mutant causes a compiler error."""
        text = ""
        for fault in faults:
            text += f"if {self.active(fault)} {{/*[{fault.number}*/{alternative(fault)}/*]*/}} else "
        return f"{text}{{ {original} }}"

    def changed(self, node, faults):
        genre = faults[0].genre
        if node.type == "function_item":
            body = node.child_by_field_name("body")
            returned = node.child_by_field_name("return_type")
            if returned is not None and returned.text.startswith(b"impl "):
                return self.plain(node, [(body, self.unnamed(body, faults))])
            opening = body.children[0]
            given = "".join(f"if {self.active(f)} {{/*[{f.number}*/return {f.replacement};/*]*/}} " for f in faults)
            inner = self.plain(body, [(opening, "{ " + given)])
            return self.plain(node, [(body, inner)])
        if node.type == "match_arm":
            pattern = node.child_by_field_name("pattern")
            conditions = " && ".join(f"!{self.active(f)}" for f in faults)
            guard = pattern.child_by_field_name("condition")
            if guard is None:
                return self.plain(node, [(pattern, f"{self.text(pattern)} if {conditions}")])
            return self.plain(node, [(pattern, self.plain(pattern, [(guard, f"{conditions} && ({self.text(guard)})")]))])
        if node.type == "match_pattern":
            guard = node.child_by_field_name("condition")
            given = f"({self.text(guard)})"
            for fault in faults:
                active = self.active(fault)
                given = f"({active} || {given})" if fault.replacement == "true" else f"(!{active} && {given})"
            return self.plain(node, [(guard, given)])
        if node.type == "struct_expression":
            return self.choice(faults, self.plain(node), lambda fault: self.without_field(node, fault))
        if node.type == "unary_expression":
            operand = self.text(node.children[-1])
            operator = self.slice(node.start_byte, node.children[-1].start_byte)
            alternatives = self.choice(faults, f"{operator}mutant_l", lambda _: "mutant_l")
            return f"(match {{ {operand} }} {{ mutant_l => {alternatives} }})"
        left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
        operator = self.slice(*next((c.start_byte, c.end_byte) for c in node.children if not c.is_named))
        if node.type == "compound_assignment_expr":
            place = self.text(left)
            alternatives = self.choice(
                faults, f"{place} {operator} mutant_r", lambda fault: f"{place} {fault.replacement} mutant_r"
            )
            return f"match {self.text(right)} {{ mutant_r => {alternatives} }}"
        if operator in {"&&", "||"}:
            active = self.active(faults[0])
            assert len(faults) == 1 and faults[0].replacement in {"&&", "||"}, faults[0].words
            return f"({active} ^ (({active} ^ ({self.text(left)})) {operator} ({active} ^ ({self.text(right)}))))"
        compares = operator in {"==", "!=", "<", ">", "<=", ">="}
        mark, deref = ("&", "*") if compares else ("", "")
        alternatives = self.choice(
            faults,
            f"{deref}mutant_l {operator} {deref}mutant_r",
            lambda fault: f"{deref}mutant_l {fault.replacement} {deref}mutant_r",
        )
        scrutinee = f"({mark}({self.text(left)}), {mark}({self.text(right)}))"
        return f"(match {scrutinee} {{ (mutant_l, mutant_r) => {alternatives} }})"

    def unnamed(self, body, faults):
        """Returns the mutated body of a function with the return type `impl Iterator`."""
        planted = f"{self.path}::mutants::Either::Planted"
        # Callers may send the iterator to another thread.
        dynamic = "::std::boxed::Box<dyn ::core::iter::Iterator<Item = _> + ::core::marker::Send>"
        text = ""
        for fault in faults:
            given = f"return {planted}(::std::boxed::Box::new({fault.replacement}) as {dynamic});"
            text += f"if {self.active(fault)} {{/*[{fault.number}*/{given}/*]*/}} "
        return f"{{ {text} {self.path}::mutants::Either::Own({self.plain(body)}) }}"

    def without_field(self, node, fault):
        body = node.child_by_field_name("body")
        parts = []
        for child in body.named_children:
            if not child.start_byte <= fault.at < child.end_byte and child.type != "line_comment":
                parts.append(self.text(child))
        return f"{self.slice(node.start_byte, body.start_byte)}{{ {', '.join(parts)} }}"


class Copy:
    """The instrumented copy of the project."""

    def __init__(self, folder, faults, jobs):
        self.tree = folder / "tree"
        self.folder = folder
        self.faults = {fault.number: fault for fault in faults}
        self.unviable = {}
        self.jobs = jobs
        flags = f"{os.environ.get('RUSTFLAGS', '')} --cap-lints allow"
        self.environment = os.environ | {
            "CARGO_TARGET_DIR": str(folder / "target"),
            "CARGO_INCREMENTAL": "0",
            "CARGO_PROFILE_DEV_DEBUG": "none",
            "CARGO_PROFILE_TEST_DEBUG": "none",
            "RUSTC_BOOTSTRAP": "1",
            "RUSTFLAGS": flags,
        }

    def make(self):
        shutil.rmtree(self.tree, ignore_errors=True)
        self.tree.mkdir(parents=True)
        listing = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        archive = subprocess.run(listing, cwd=HERE, check=True, capture_output=True).stdout
        for name in filter(None, archive.decode().split("\0")):
            (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(HERE / name, self.tree / name)
        count = max(self.faults, default=0) + 1
        (self.tree / "crates" / "surd" / "src" / "mutants.rs").write_text(ACTIVE_MODULE.replace("COUNT", str(count)))
        self.originals = {}
        for file in {fault.file for fault in self.faults.values()} | {"crates/surd/src/lib.rs", "src/lib.rs"}:
            self.originals[file] = (self.tree / file).read_bytes()
        self.write()

    def write(self, files=None):
        by_file = collections.defaultdict(list)
        for fault in self.faults.values():
            by_file[fault.file].append(fault)
        for file in files or self.originals:
            rewriter = Rewriter(self.originals[file], by_file[file], path_to_questions(file))
            for fault in rewriter.apart:
                self.drop(fault, "no expression of its own")
            text = rewriter.whole()
            if file == "src/lib.rs":
                text += "\n#[allow(missing_docs)]\npub use exact_surd::mutants;\n"
            if file == "crates/surd/src/lib.rs":
                head = "#![feature(core_intrinsics, const_eval_select)]\n#![allow(internal_features)]\n"
                text = head + text + "\n#[allow(missing_docs)]\npub mod mutants;\nextern crate std;\n"
            (self.tree / file).write_text(text)

    def drop(self, fault, why):
        if self.faults.pop(fault.number, None):
            self.unviable[fault.number] = (fault, why)

    def cargo(self, *words):
        return subprocess.run(
            ["cargo", *words, "--workspace", "--exclude", TESTKIT, "--all-features", "--message-format", "json"],
            cwd=self.tree,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
        )

    def blamed(self, error):
        """Returns the mutants that can cause a compiler error: those of the alternative around it, or else of the expression.
        If there are none, those around the other places that the error names: a value can be moved in a mutant and used
        after it."""
        return self.blamed_at(error, primary=True) or self.blamed_at(error, primary=False)

    def blamed_at(self, error, primary):
        found = set()
        for span in error["spans"]:
            if span["is_primary"] != primary:
                continue
            path = self.tree / span["file_name"]
            if not path.exists():
                continue
            text = path.read_bytes()
            if (error["code"] or {}).get("code") == "E0004":
                found |= self.arms(text, span["byte_start"])
            else:
                at = span["byte_start"]
                found |= set(enclosing(text, at, b"[", b"]")) or set(enclosing(text, at, b"<", b">"))
        return found

    def arms(self, text, at):
        """Returns the mutants that delete an arm of the match expression around a position."""
        leaf = PARSER.parse(text).root_node.descendant_for_byte_range(at, at)
        node = enclosing_node(leaf, {"match_expression"})
        if node is None:
            return set()
        inside = {int(number) for number in re.findall(rb"if !\w+::mutants::active\((\d+)\)", node.text)}
        return {number for number in inside if number in self.faults and self.faults[number].genre == "MatchArm"}

    def settle(self):
        """Removes mutants that do not compile, until the rest compiles."""
        while True:
            completed = self.cargo("check", "--lib", "--bins")
            errors = [
                line["message"]
                for line in map(json.loads, completed.stdout.splitlines())
                if line["reason"] == "compiler-message" and line["message"]["level"] == "error" and line["message"]["spans"]
            ]
            if completed.returncode == 0:
                return
            files, lost = set(), 0
            for error in errors:
                for number in self.blamed(error) & self.faults.keys():
                    files.add(self.faults[number].file)
                    self.drop(self.faults[number], error["message"])
                    lost += 1
            print(f"{len(errors)} errors, {lost} mutants left out", flush=True)
            if not lost:
                for error in errors[:20]:
                    print(error["rendered"])
                print(completed.stderr[-3000:])
                raise SystemExit("the instrumented code does not compile")
            self.write(files)

    def build(self):
        completed = self.cargo("test", "--no-run", "--lib", "--bins", "--tests")
        if completed.returncode:
            print(completed.stderr[-4000:])
            raise SystemExit("the tests do not build")
        # Each binary runs in the folder of its package, as with `cargo test`. Binaries of examples contain no tests.
        return [
            (line["executable"], str(Path(line["manifest_path"]).parent))
            for line in map(json.loads, completed.stdout.splitlines())
            if line["reason"] == "compiler-artifact"
            and line["executable"]
            and line["profile"]["test"]
            and "example" not in line["target"]["kind"]
        ]


def enclosing(text, at, opening, closing):
    """Returns the numbers of the mutants in the innermost pair of marks around a position."""
    depth = 0
    pattern = rb"/\*(?:" + re.escape(opening) + rb"([\d,]+)|" + re.escape(closing) + rb")\*/"
    for mark in reversed(list(re.finditer(pattern, text[:at]))):
        if mark[1] is None:
            depth += 1
        elif depth:
            depth -= 1
        else:
            return [int(number) for number in mark[1].split(b",")]
    return []


def limits():
    """Limits the memory, because a mutant may allocate without bound, and starts a session, so that `killpg` ends all of it."""
    resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    os.setsid()


class Tests:
    """All tests, with their times and the mutants that they reach."""

    def __init__(self, copy):
        self.copy = copy

    def run(self, binary, names, seconds, **environment):
        """Runs tests of a binary, one after the other. Returns whether all pass, or `None` after a timeout."""
        executable, folder = binary
        own = {"CARGO_MANIFEST_DIR": folder, "PROPTEST_FAILURE_PERSISTENCE": "off"}
        process = subprocess.Popen(
            [executable, "--exact", "--test-threads", "1", *names],
            cwd=folder,
            env=self.copy.environment | own | environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            preexec_fn=limits,
        )
        try:
            return process.wait(seconds) == 0
        except subprocess.TimeoutExpired:
            return None
        finally:
            try:
                os.killpg(process.pid, 9)
            except ProcessLookupError:
                pass
            process.wait()

    def record(self, binaries, jobs, slowest):
        """Runs each test alone for at most `slowest` seconds. Returns its time and the mutants that it reaches."""
        tests = []
        for binary in binaries:
            listing = [binary[0], "--list", "--format", "terse"]
            listed = subprocess.run(listing, capture_output=True, text=True, check=True).stdout
            tests += [(binary, line.removesuffix(": test")) for line in listed.splitlines() if line.endswith(": test")]
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            return list(pool.map(lambda test: self.timed(*test, slowest), tests))

    def record_slow_ones(self, recorded, jobs, slowest):
        """Runs the tests again that took longer than an earlier limit."""
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            again = lambda test: self.timed(test["binary"], test["name"], slowest) if test["passed"] is None else test
            return list(pool.map(again, recorded))

    def timed(self, binary, name, slowest):
        """Runs a test for at most `slowest` seconds. Returns its time and the mutants that it reaches."""
        with tempfile.NamedTemporaryFile(dir=self.copy.folder) as reached:
            began = time.monotonic()
            passed = self.run(binary, [name], slowest, MUTANTS_REACHED=reached.name)
            seconds = time.monotonic() - began
            seen = sorted({int(line) for line in Path(reached.name).read_text().split()})
        return {"binary": binary, "name": name, "passed": passed, "seconds": seconds, "reached": seen}


class Attack:
    """Runs tests on mutants."""

    def __init__(self, tests, recorded, most):
        self.tests = tests
        self.most = most
        self.recorded = [test for test in recorded if test["passed"]]
        self.reaching = collections.defaultdict(list)
        for index, test in enumerate(self.recorded):
            for number in test["reached"]:
                self.reaching[number].append(index)
        self.kills = collections.defaultdict(collections.Counter)
        self.lock = threading.Lock()

    def order(self, fault):
        """Returns the tests that reach a mutant, in order of cost. Kills in the same file lower the cost."""
        with self.lock:
            kills = dict(self.kills[fault.file])

        def cost(index):
            test = self.recorded[index]
            return (0.02 + test["seconds"]) * math.sqrt(1 + len(test["reached"])) / (1 + 3 * kills.get(index, 0))

        return sorted(self.reaching[fault.number], key=cost)

    def passes(self, binary, chunk, fault):
        """Returns whether these tests of a binary pass with the mutant."""
        tests = [self.recorded[index] for index in chunk]
        seconds = 10 + 5 * sum(test["seconds"] for test in tests)
        return self.tests.run(binary, [test["name"] for test in tests], seconds, MUTANT=str(fault.number))

    def judge(self, fault):
        began = time.monotonic()
        order = self.order(fault)
        if not order:
            return {"outcome": "not reached", "seconds": 0}
        at, size, spent = 0, 1, 0.0
        while at < len(order):
            binary = self.recorded[order[at]]["binary"]
            chunk = []
            while at < len(order) and len(chunk) < size and self.recorded[order[at]]["binary"] == binary:
                chunk.append(order[at])
                at += 1
            expected = sum(self.recorded[index]["seconds"] for index in chunk)
            if spent + expected > self.most and spent:
                return {"outcome": "survives so far", "seconds": time.monotonic() - began, "left": len(order) - at + len(chunk)}
            spent += expected
            if not self.passes(binary, chunk, fault):
                # Each test of the group runs again on its own, which finds the killer and rules out an unrelated failure.
                by = next((index for index in chunk if not self.passes(binary, [index], fault)), None)
                if by is not None:
                    with self.lock:
                        self.kills[fault.file][by] += 1
                    return {"outcome": "killed", "seconds": time.monotonic() - began, "by": self.recorded[by]["name"]}
            size *= 2
        return {"outcome": "survives", "seconds": time.monotonic() - began, "tests": len(order)}


def listed(folder):
    """Returns the mutants of cargo-mutants, numbered."""
    path = folder / "listed.json"
    listing = ["cargo", "mutants", "--workspace", "--list", "--json"]
    completed = subprocess.run(listing, cwd=HERE, check=True, capture_output=True, text=True)
    path.write_text(completed.stdout)
    texts = {}
    faults = []
    times = collections.Counter()
    for number, one in enumerate(one for one in json.loads(completed.stdout) if one["package"] != TESTKIT):
        file = one["file"]
        if file not in texts:
            texts[file] = (HERE / file).read_text()
        fault = Fault(number, one, texts[file])
        times[fault.key] += 1
        # Mutants on the same line, or on lines with the same text, may have the same key. From the second on they get a number.
        if times[fault.key] > 1:
            fault.key += f" #{times[fault.key]}"
        faults.append(fault)
    return faults


def changed_lines(commit):
    """Returns the source lines that differ from a commit, as (file, line). Lines of a renamed file differ only if edited."""
    diff = ["git", "diff", "-U0", "--find-renames=40%", "-l0", commit, "--", *SOURCES]
    completed = subprocess.run(diff, cwd=HERE, check=True, capture_output=True, text=True).stdout
    lines, file = set(), None
    for line in completed.splitlines():
        if line.startswith("+++ b/"):
            file = line.removeprefix("+++ b/")
        hunk = re.match(r"@@ -\S+ \+(\d+)(?:,(\d+))? @@", line)
        if hunk:
            first, count = int(hunk[1]), int(hunk[2] or 1)
            lines |= {(file, number) for number in range(first, first + count)}
    return lines


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="DIR", help="the folder of the instrumented copy, its build and the results")
    parser.add_argument("--room", action="append", help="only mutants of this crate, or module of the main crate")
    parser.add_argument("--changed", metavar="COMMIT", help="test only mutants in lines that differ from this commit")
    parser.add_argument("--sample", type=int, metavar="N", help="test only N mutants, a random sample with a fixed seed")
    parser.add_argument("--shard", default="0/1", metavar="I/N", help="test only every N-th mutant, from number I on")
    parser.add_argument("--slowest", type=float, default=600, metavar="S", help="leave out tests that take more than S seconds")
    parser.add_argument("--seconds", type=float, default=1e9, metavar="S", help="start no further mutant after S seconds")
    parser.add_argument("--most", type=float, default=1e9, metavar="S", help="run tests for at most about S seconds per mutant")
    parser.add_argument("--least", type=float, metavar="P", help="fail only if less than P %% are killed, or survive as listed")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    return parser.parse_args()


def chosen(faults, arguments):
    if arguments.room:
        faults = [fault for fault in faults if room(fault.file) in arguments.room]
    else:
        faults = [fault for fault in faults if room(fault.file) not in TOOLS and fault.file not in RECORDS]
    if arguments.changed:
        lines = changed_lines(arguments.changed)
        faults = [fault for fault in faults if (fault.file, int(fault.place.split(":")[1])) in lines]
    first, count = map(int, arguments.shard.split("/"))
    faults = faults[first::count]
    if arguments.sample and arguments.sample < len(faults):
        faults = sorted(random.Random(1).sample(faults, arguments.sample), key=lambda fault: fault.number)
    return faults


def main():
    arguments = options()
    began = time.monotonic()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    state = folder / "state.json"
    planted = listed(folder)
    # Every survivor on the list must still be a mutant.
    if stale := sorted(survivors().keys() - {fault.key for fault in planted}):
        raise SystemExit("in .ci/mutants.survivors, but not among the mutants:\n" + "\n".join(stale))
    copy = Copy(folder, chosen(planted, arguments), arguments.jobs)
    everything = dict(copy.faults)
    print(f"{len(everything)} mutants", flush=True)
    if not everything:
        return 0
    if state.exists():
        known = json.loads(state.read_text())
        copy.faults = {number: everything[number] for number in known["viable"] if number in everything}
        unviable = {int(number): why for number, why in known["unviable"].items()}
        copy.unviable = {number: (everything[number], why) for number, why in unviable.items() if number in everything}
        recorded = known["recorded"]
        has_more_tests = arguments.slowest > known["slowest"]
        if has_more_tests:
            recorded = Tests(copy).record_slow_ones(recorded, arguments.jobs, arguments.slowest)
            state.write_text(json.dumps(known | {"recorded": recorded, "slowest": arguments.slowest}))
    else:
        has_more_tests = False
        copy.make()
        copy.settle()
        print(f"{len(copy.faults)} compile, {time.monotonic() - began:.0f} s", flush=True)
        binaries = copy.build()
        print(f"built, {time.monotonic() - began:.0f} s", flush=True)
        recorded = Tests(copy).record(binaries, arguments.jobs, arguments.slowest)
        unviable = {number: why for number, (_, why) in copy.unviable.items()}
        known = {"viable": sorted(copy.faults), "unviable": unviable, "recorded": recorded, "slowest": arguments.slowest}
        state.write_text(json.dumps(known))
    failing = [test["name"] for test in recorded if test["passed"] is False]
    slow = [test["name"] for test in recorded if test["passed"] is None]
    print(f"{len(recorded)} tests, {sum(t['seconds'] for t in recorded):.0f} s of them, {time.monotonic() - began:.0f} s", flush=True)
    if failing:
        print(f"left out, because they fail without a mutant: {', '.join(failing)}", flush=True)
    if slow:
        print(f"left out, because they take longer than {arguments.slowest:.0f} s: {', '.join(slow)}", flush=True)

    results = folder / "results.jsonl"
    done = {}
    if results.exists():
        done = {one["number"]: one for one in map(json.loads, results.read_text().splitlines())}
    attack = Attack(Tests(copy), recorded, arguments.most)
    reasons = survivors()

    def is_to_be_shown(fault):
        """Returns whether a mutant has no outcome yet, or more tests remain that a larger --most or --slowest allows."""
        one = done.get(fault.number)
        if one is None:
            return True
        has_rest = one["outcome"] == "survives so far" and arguments.most > one["most"]
        return (has_rest or has_more_tests and one["outcome"] in UNNOTICED) and fault.key not in reasons

    # In random order, because then the mutants tested within --seconds are a random sample.
    todo = [fault for fault in copy.faults.values() if is_to_be_shown(fault)]
    random.Random(2).shuffle(todo)
    with results.open("a") as out, concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:

        def one(fault):
            if time.monotonic() - began > arguments.seconds:
                return
            judged = {"number": fault.number, "key": fault.key, "place": fault.place, "most": arguments.most} | attack.judge(fault)
            with attack.lock:
                done[fault.number] = judged
                out.write(json.dumps(judged) + "\n")
                out.flush()

        list(pool.map(one, todo))
    raise SystemExit(report(copy, everything, done, arguments.least))


def survivors():
    """Returns the reason for each survivor on the list, by key."""
    reasons = {}
    if SURVIVORS.exists():
        for line in SURVIVORS.read_text().splitlines():
            if line and not line.startswith("#"):
                key, _, reason = line.partition("\t")
                reasons[key] = reason
    return reasons


def report(copy, everything, done, least):
    """Prints the outcomes by module, and the mutants that contradict the list of survivors. Returns whether the run fails."""
    reasons = survivors()
    table = collections.defaultdict(collections.Counter)
    for number, fault in everything.items():
        outcome = "unviable" if number in copy.unviable else done.get(number, {"outcome": "not run"})["outcome"]
        if fault.key in reasons and outcome in UNNOTICED:
            outcome = "listed"
        table[room(fault.file)][outcome] += 1
        table["all"][outcome] += 1
    columns = ["killed", "listed", *UNNOTICED, "not run", "unviable"]
    print("| module | " + " | ".join(columns) + " | killed of viable |")
    print("|---|" + "--:|" * (len(columns) + 1))
    for name, counts in sorted(table.items(), key=lambda entry: (entry[0] == "all", entry[0])):
        judged = sum(counts[column] for column in columns[:5])
        share = f"{100 * counts['killed'] / judged:.1f} %" if judged else ""
        print(f"| {name} | " + " | ".join(str(counts[column]) for column in columns) + f" | {share} |")
    wrong = 0
    for number, one in sorted(done.items()):
        known = one["key"] in reasons
        if known == (one["outcome"] == "killed"):
            wrong += 1
            print(f"{one['outcome'].upper()}{', though listed' if known else ''}: {one['place']}: {one['key']}")
    return wrong > 0 if least is None else 100 * (len(done) - wrong) < least * len(done)


if __name__ == "__main__":
    sys.exit(main())
