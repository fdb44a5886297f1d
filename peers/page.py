"""Tests the page of `cannonpile export --to html` in a browser: `page.py FOLDER`. CANNONPILE is the path of the binary.

The tests check pictures by their pixels, and the tables of all spheres against the output of `cannonpile contacts` and `base`
for the same scene. They select by pointer, touch and key. A page may report no error and request nothing but its file.
"""

import csv
import io
import os
import pathlib
import subprocess
import sys
from fractions import Fraction

from browser import Browser

folder = pathlib.Path(sys.argv[1])


def cannonpile(*words):
    completed = subprocess.run([os.environ["CANNONPILE"], *words], check=False, capture_output=True, text=True)
    if completed.returncode not in (0, 1):
        raise AssertionError(completed.stderr)
    return completed.stdout


def table(command, *scene):
    return list(csv.DictReader(io.StringIO(cannonpile(command, "--format", "csv", *scene))))


def check(holds, *what):
    if not holds:
        raise AssertionError(" ".join(str(part) for part in what))


def near(colour, other, by):
    return all(abs(a - b) <= by for a, b in zip(colour, other))


ROWS = """var rows = () => [...document.querySelectorAll('#chosen tbody tr')].map((row) => {
  const cells = [...row.querySelectorAll('td')].filter((cell) => cell.querySelector('button') === null);
  return {
    head: row.querySelector('th').textContent,
    other: row.querySelector('td button')?.textContent ?? null,
    exact: cells.map((cell) => [...cell.querySelectorAll('.exact')].map((number) => number.textContent)),
  };
})"""


class Shown:
    """An open viewer of a scene."""

    def __init__(self, browser, name, *scene, **how):
        self.browser, self.path = browser, folder / f"{name}.html"
        cannonpile("export", str(self.path), "--to", "html", *scene)
        browser.open(self.path, **how)
        check(self.run("cannonpile.view.frames > 0"), name, "is not drawn")
        self.box = self.run("(({ left, top }) => [left, top])(document.getElementById('picture').getBoundingClientRect())")
        self.ground = self.run("cannonpile.view.theme().ground.map((part) => Math.round(255 * part))")

    def run(self, script):
        return self.browser.run(script)

    def press_button(self, name):
        self.run(f"document.getElementById('{name}').click()")

    def find(self, text):
        self.run(f"document.getElementById('sphere').value = '{text}'; document.getElementById('find').requestSubmit()")

    def at(self, sphere):
        """Returns the position of a sphere in the window."""
        x, y, *_ = self.run(f"cannonpile.project({sphere}, 0)")
        return self.box[0] + x, self.box[1] + y

    def is_ground(self, x, y):
        return near(self.browser.picture().getpixel((round(x), round(y))), self.ground, 12)

    def chosen(self):
        return self.run("cannonpile.view.chosen.sphere")

    def rows(self):
        return self.run(f"{ROWS}; rows()")

    def spheres(self, ids):
        """Selects each sphere by its number, and returns its indices and the rows of its table."""
        return self.run(
            f"{ROWS}; {ids}.map((sphere) => {{ cannonpile.choose({{ sphere }});"
            " return { sphere, place: cannonpile.pile.place(sphere).split(','), rows: rows() }; })"
        )

    def quiet(self):
        check(self.browser.errors == [], self.browser.errors)
        check(len(self.browser.requests) == 1 and self.browser.requests[0].startswith("file:///"), self.browser.requests)


GREEK = {"α": "alpha", "β": "beta", "γ": "gamma", "αβ": "alpha-beta", "αγ": "alpha-gamma", "γβ": "gamma-beta"}


def row_numbers(row, state=0, states=1):
    """Returns the exact multiple and the exact force in N of a row for a state, or None."""
    cells = row["exact"] if states == 1 else [row["exact"][state]]
    numbers = [number.removesuffix(" N") for cell in cells for number in cell]
    return numbers if len(numbers) == 2 else ["0", "0"] if numbers == ["0"] else None


def judge_sphere(shown_table, exact, newtons, state=0, states=1):
    """Compares the table of a sphere with `contacts`, exactly and in N, and returns the number of contacts."""
    judged = 0
    for row in shown_table["rows"]:
        if row["other"] is None:
            continue
        side, way = row["head"].split(", ")
        other = row["other"].split("(")[1].rstrip(")").split(",")
        named = {"below": [shown_table["place"]], "above": [other], "beside": [shown_table["place"], other]}[side]
        keys = [key for key in ((*place, GREEK[way]) for place in named) if key in exact]
        found = row_numbers(row, state, states)
        if side == "beside" and not keys:
            check(found in (None, ["0", "0"]), shown_table["sphere"], row)
            continue
        check(any(found == [exact[key], newtons[key]] for key in keys), shown_table["sphere"], row, [exact[key] for key in keys])
        judged += 1
    check(judged > 0, "sphere", shown_table["sphere"], "has no contact in its table")
    return judged


def forces(*scene):
    key = lambda row: tuple(row[head] for head in ("k", "i", "j", "direction") if head in row)
    exact = {key(row): row["force"] for row in table("contacts", *scene)}
    newtons = {key(row): row["force"] for row in table("contacts", "--units", "si", *scene)}
    return exact, newtons


def spheres_are_drawn_and_selected(browser):
    scene = ["--top", "hexagon:3", "--stacking", "hcp", "--layers", "4"]
    exact, newtons = forces(*scene)
    shown = Shown(browser, "hcp", *scene)
    shown.press_button("above")
    # From above all 19 spheres of the top layer are visible, and the background around the pile.
    check(shown.is_ground(shown.box[0] + 5, shown.box[1] + 5), "the ground is not drawn")
    check(not any(shown.is_ground(*shown.at(sphere)) for sphere in range(1, 20)), "a sphere is not drawn")
    for sphere in [1, 10, 19]:
        browser.click(*shown.at(sphere))
        check(shown.chosen() == sphere, "a click selects", shown.chosen())
    shown.run("document.getElementById('picture').focus()")
    browser.press("Escape")
    check(shown.run("document.querySelector('#chosen h2').textContent") == "No selection", "Escape does not deselect")
    browser.press("Enter")
    first = shown.chosen()
    browser.press("ArrowRight", shift=True)
    check(shown.chosen() != first and shown.at(shown.chosen())[0] > shown.at(first)[0] + 5, "ArrowRight does not go right")
    for text, sphere in [("41", "41"), ("2 0 -1", "cannonpile.pile.find('2,0,-1')")]:
        shown.find(text)
        check(shown.run(f"cannonpile.view.chosen.sphere === {sphere}"), text)
    # All spheres, and the base forces.
    everything = shown.spheres("Array.from({ length: cannonpile.pile.count }, (_, n) => n + 1)")
    judged = sum(judge_sphere(shown_table, exact, newtons) for shown_table in everything)
    check(judged == 2 * len(exact), judged, "contacts, not", 2 * len(exact))
    base = table("base", *scene)
    for shown_table, wanted in zip(everything[-len(base) :], base):
        check(shown_table["place"][1:] == [wanted["i"], wanted["j"]], shown_table, wanted)
        for row, column in zip(shown_table["rows"][-3:], ["normal", "shear_x", "shear_y"]):
            check(row["exact"][0] == [wanted[column]], row, wanted)
    shown.quiet()
    return judged


def tensile_contacts_are_found(browser):
    scene = ["--stacking", "hcp", "--layers", "7"]
    exact, newtons = forces(*scene)
    shown = Shown(browser, "falls", *scene)
    tensile = sum(Fraction(force) < 0 for force in exact.values())
    check(f"In {tensile} contacts" in shown.run("document.getElementById('verdict').textContent"), tensile)
    found = set()
    for _ in range(tensile):
        shown.press_button("seek-pulls")
        contact = shown.run("cannonpile.view.chosen.contact")
        place = shown.run(f"cannonpile.pile.place(cannonpile.pile.ends[0][{contact}])").split(",")
        way = shown.run(f"cannonpile.pile.wayNames[cannonpile.pile.wayOf[{contact}]]")
        numbers = row_numbers(shown.rows()[0])
        check(numbers == [exact[*place, way], newtons[*place, way]] and Fraction(numbers[0]) < 0, contact, numbers)
        found.add(contact)
    check(len(found) == tensile, found)
    shown.quiet()
    return tensile


def layers_are_hidden(browser):
    shown = Shown(browser, "fcc", "--layers", "10")
    shown.press_button("front")
    x, y = shown.at(1)
    check(not shown.is_ground(x, y), "no apex")
    shown.run("(() => { const cut = document.getElementById('cut-from'); cut.value = 5; cut.dispatchEvent(new Event('input')); })()")
    check(shown.is_ground(x, y), "the apex is still visible")
    shown.find("1")
    check(not shown.is_ground(x, y), "a hidden sphere that is selected is not shown")
    shown.quiet()
    return 1


def both_states_are_shown(browser):
    exact, newtons = forces("--stacking=+-+-+", "--state", "elastic")
    isostatic, of_isostatic = forces("--stacking=+-+-+", "--spacing", "1")
    shown = Shown(browser, "elastic", "--stacking=+-+-+", "--state", "elastic")
    sloping = pushing = 0
    for shown_table in shown.spheres("Array.from({ length: cannonpile.pile.firstOnFloor - 1 }, (_, n) => n + 1)"):
        sloping += judge_sphere(shown_table, isostatic, of_isostatic, state=0, states=2)
        pushing += judge_sphere(shown_table, exact, newtons, state=1, states=2)
    # Three horizontal contacts have a force, and the others are open.
    check(pushing == sloping + 2 * (len(exact) - len(isostatic)) and len(exact) == len(isostatic) + 3, sloping, pushing)
    check(any(isostatic[key] != exact[key] for key in isostatic), "one state only")
    shown.quiet()
    return sloping + pushing


def phone_is_touched(browser):
    shown = Shown(browser, "phone", "--top", "hexagon:5", "--stacking", "hcp", "--layers", "5", size=(390, 844), touch=True)
    wide = shown.run("[document.documentElement.scrollWidth, innerWidth]")
    check(wide[0] <= wide[1], "a phone has to scroll horizontally", wide)
    shown.press_button("above")
    sphere = shown.run("cannonpile.pile.find('0,0,0')")
    x, y = shown.at(sphere)
    browser.touch([(x, y)])
    check(shown.chosen() == sphere, "a tap does not select")
    distance = shown.run("cannonpile.view.camera.distance")
    browser.touch([(x - 20, y), (x + 20, y)], [(x - 40, y), (x + 40, y)], [(x - 60, y), (x + 60, y)])
    check(shown.run("cannonpile.view.camera.distance") < 0.6 * distance, "a pinch does not zoom")
    shown.quiet()
    return 2


def texts_are_no_markup(browser):
    """Checks that markup in the data is displayed as text, and that the content security policy blocks scripts and requests."""
    shown = Shown(browser, "plain", "--layers", "3")
    planted, text = folder / "planted.html", shown.path.read_text()
    check("A pile of 10 spheres in 3 layers" in text, "no title")
    markup = "\\u003c/script>\\u003cimg src=x onerror=alert(1)>\\u003cscript>throw 1\\u003c/script>"
    planted.write_text(text.replace("A pile of 10 spheres in 3 layers", markup))
    browser.open(planted)
    check("<img src=x" in browser.run("document.getElementById('title').textContent"), "the title is not shown as it is")
    check(browser.run("document.images.length") == 0, "a picture was made of a text")
    shown.quiet()
    planted.write_text(text.replace("</body>", "<script>globalThis.ran = 1</script><img src='https://example.org/'></body>"))
    browser.open(planted)
    check(browser.run("globalThis.ran === undefined"), "another script has run")
    refused = " ".join(browser.errors)
    check("Executing inline script violates" in refused and "Loading the image" in refused, "the policy does not hold", refused)
    return 4


def table_needs_no_webgl(_):
    with Browser("--disable-gpu", "--disable-webgl", "--disable-3d-apis") as browser:
        browser.open(folder / "hcp.html")
        check(not browser.run("document.getElementById('undrawn').hidden"), "no word on what is missing")
        browser.run("document.getElementById('sphere').value = '1'; document.getElementById('find').requestSubmit()")
        check(browser.run("document.querySelectorAll('#chosen tbody tr').length") > 3, "no table")
    return 2


TESTS = [spheres_are_drawn_and_selected, tensile_contacts_are_found, layers_are_hidden, both_states_are_shown, phone_is_touched,
         texts_are_no_markup, table_needs_no_webgl]
with Browser() as tab:
    counts = {test.__name__.replace("_", " "): test(tab) for test in TESTS}
for name, number in counts.items():
    print(f"{number:5} {name}")
print(f"{len(TESTS)} tests: {sum(counts.values())} forces in tables and other checks, no error, no request")
