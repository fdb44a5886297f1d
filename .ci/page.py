"""Tests the page of `cannonpile export --to html` in a browser: `page.py FOLDER`. CANNONPILE is the path of the binary.
The pages and screenshots remain in the folder.

The tests check pictures by their pixels, tables against the output of `cannonpile contacts` and `base` for the same
scene, and network requests by the record of the browser.
"""

import csv
import io
import os
import pathlib
import subprocess
import sys
import time
from fractions import Fraction

from browser import Browser

CANNONPILE = os.environ["CANNONPILE"]
folder = pathlib.Path(sys.argv[1])
SCREEN, PHONE = (1280, 860), (390, 844)


def cannonpile(*words):
    completed = subprocess.run([CANNONPILE, *words], check=False, capture_output=True, text=True)
    if completed.returncode not in (0, 1):
        raise AssertionError(completed.stderr)
    return completed.stdout


def page(name, *scene):
    path = folder / f"{name}.html"
    cannonpile("export", str(path), "--to", "html", *scene)
    return path


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
    """An open viewer."""

    def __init__(self, browser, path, **how):
        self.browser = browser
        size = how.pop("size", SCREEN)
        browser.show(*size, **how)
        browser.errors.clear()
        browser.requests.clear()
        self.seconds = browser.open(path)
        check(browser.run("cannonpile.view.frames > 0"), path, "is not drawn")

    def run(self, script):
        value = self.browser.run(script)
        self.browser.settle()
        return value

    def at(self, sphere, state=0):
        """Returns the position of a sphere in the window."""
        return self.run(
            f"(() => {{ const box = document.getElementById('picture').getBoundingClientRect(); "
            f"const [x, y] = cannonpile.project({sphere}, {state}); return [box.left + x, box.top + y]; }})()"
        )

    def rows(self):
        """Returns the rows of the table: head, neighbour, and the exact numbers of each cell."""
        return self.browser.run(f"{ROWS}; rows()")

    def spheres(self, ids):
        """Selects each sphere by its number, and returns its indices and the rows of its table."""
        return self.browser.run(
            f"{ROWS}; {ids}.map((sphere) => {{ cannonpile.choose({{ sphere }});"
            " return { sphere, place: cannonpile.pile.place(sphere).split(','), rows: rows() }; })"
        )

    def chosen(self):
        """Returns the indices of the selected sphere, and the rows of its table."""
        sphere = self.run("cannonpile.view.chosen.sphere")
        return {"sphere": sphere, "place": self.run(f"cannonpile.pile.place({sphere}).split(',')"), "rows": self.rows()}

    def heading(self):
        return self.run("document.querySelector('#chosen h2').textContent")

    def quiet(self):
        """Checks that there were no errors, and no requests except for the file."""
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
    heads = ["k", "i", "j", "direction"]
    key = lambda row: tuple(row[head] for head in heads if head in row)
    exact = {key(row): row["force"] for row in table("contacts", *scene)}
    newtons = {key(row): row["force"] for row in table("contacts", "--units", "si", *scene)}
    return exact, newtons


# Viridis of Matplotlib, at quarters from the smallest to the largest value.
VIRIDIS = [(68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37)]


def viridis(part):
    place = min(int(4 * part), 3)
    return [a + (4 * part - place) * (b - a) for a, b in zip(VIRIDIS[place], VIRIDIS[place + 1])]


def loads(*scene):
    """Returns the load that each sphere transmits, in mg: a third of its forces below, or the base normal force."""
    passed = {}
    for row in table("contacts", *scene):
        place = (row["k"], row["i"], row["j"])
        passed[place] = passed.get(place, 0) + Fraction(row["force"]) / 3
    floor = str(max(int(k) for k, _, _ in passed) + 1)
    return passed | {(floor, row["i"], row["j"]): Fraction(row["normal"]) for row in table("base", *scene)}


def hue(colour):
    total = sum(colour) or 1
    return [part / total for part in colour]


def cut(shown, end, layer):
    """Moves a slider for the visible layers."""
    shown.run(
        f"(() => {{ const cut = document.getElementById('cut-{end}'); cut.value = {layer};"
        " cut.dispatchEvent(new Event('input')); })()"
    )


def draws_and_picks(browser):
    scene = ["--top", "hexagon:3", "--stacking", "hcp", "--layers", "4"]
    exact, newtons = forces(*scene)
    shown = Shown(browser, page("hcp", *scene))
    shown.run("document.getElementById('above').click()")
    # From above all 19 spheres of the top layer are visible with their colours, and the background around the pile.
    picture = browser.picture(folder / "hcp.png")
    ground = shown.run("cannonpile.view.theme().ground.map((part) => Math.round(255 * part))")
    box = shown.run("(({ left, top }) => [left, top])(document.getElementById('picture').getBoundingClientRect())")
    check(near(picture.getpixel((round(box[0] + 5), round(box[1] + 5))), ground, 3), "the ground is not drawn")
    passed = loads(*scene)
    least, most = min(passed.values()), max(passed.values())

    def judge_colours(spheres, picture):
        for sphere in spheres:
            x, y = shown.at(sphere)
            seen = picture.getpixel((round(x), round(y)))
            load = passed[tuple(shown.browser.run(f"cannonpile.pile.place({sphere}).split(',')"))]
            wanted = viridis(float((load - least) / (most - least)))
            check(not near(seen, ground, 20), "no sphere", sphere, "at", x, y)
            check(max(abs(a - b) for a, b in zip(hue(seen), hue(wanted))) < 0.12, "sphere", sphere, "is", seen, "not", wanted)

    judge_colours(range(1, 20), picture)
    # The bottom layer alone.
    first = shown.run("cannonpile.pile.firstOnFloor")
    cut(shown, "from", 3)
    judge_colours(range(first, shown.run("cannonpile.pile.count") + 1, 5), browser.picture())
    cut(shown, "from", 0)
    # By pointer.
    for sphere in [1, 10, 19]:
        browser.click(*shown.at(sphere))
        check(shown.heading().startswith(f"Sphere {sphere} ("), shown.heading())
        judge_sphere(shown.chosen(), exact, newtons)
    check(not near(browser.picture().getpixel(tuple(round(x) for x in box)), (0, 0, 0), 1), "black")
    # By keyboard: the sphere in the middle of the picture, then its right neighbour.
    shown.run("document.getElementById('picture').focus()")
    browser.press("Escape")
    check(shown.heading() == "No selection", shown.heading())
    browser.press("Enter")
    first = shown.run("cannonpile.view.chosen.sphere")
    judge_sphere(shown.chosen(), exact, newtons)
    browser.press("ArrowRight", shift=True)
    second = shown.run("cannonpile.view.chosen.sphere")
    check(second != first and shown.at(second)[0] > shown.at(first)[0] + 5, first, second)
    judge_sphere(shown.chosen(), exact, newtons)
    # By a button of a neighbour, by number, and by indices.
    shown.run("document.querySelector('#chosen td button').click()")
    third = shown.run("cannonpile.view.chosen.sphere")
    check(third != second, third)
    judge_sphere(shown.chosen(), exact, newtons)
    for text, sphere in [("41", 41), ("0, 0, 0", shown.run("cannonpile.pile.find('0,0,0')")), ("2 0 -1", shown.run("cannonpile.pile.find('2,0,-1')"))]:
        shown.run(f"document.getElementById('sphere').value = '{text}'; document.getElementById('find').requestSubmit()")
        check(shown.run("cannonpile.view.chosen.sphere") == sphere, text)
        judge_sphere(shown.chosen(), exact, newtons)
    shown.run("document.getElementById('sphere').value = '9999'; document.getElementById('find').requestSubmit()")
    check("no such sphere" in shown.run("document.getElementById('found').textContent"), "9999")
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
    return f"{judged} forces in tables are those of the command line"


def contacts_are_picked(browser):
    scene = ["--stacking", "hcp", "--layers", "7"]
    exact, newtons = forces(*scene)
    shown = Shown(browser, page("falls", *scene))
    shown.run("document.getElementById('front').click(); document.getElementById('show-forces').click()")
    found = shown.run(
        "(() => { const { pile, view } = cannonpile; const seen = [];"
        " for (let contact = 0; contact < pile.contactCount && seen.length < 6; contact += 1) {"
        "  const ends = pile.ends.map((ids) => pile.centre(ids[contact]));"
        "  const [x, y] = view.project(ends[0].map((a, n) => (a + ends[1][n]) / 2));"
        "  if (view.pickAt(x, y).contact === contact) seen.push([contact, x, y]); }"
        " return seen; })()"
    )
    check(len(found) == 6, found)
    box = shown.run("(({ left, top }) => [left, top])(document.getElementById('picture').getBoundingClientRect())")
    picture = browser.picture(folder / "falls.png")
    ground = shown.run("cannonpile.view.theme().ground.map((part) => Math.round(255 * part))")
    for contact, x, y in found:
        check(not near(picture.getpixel((round(box[0] + x), round(box[1] + y))), ground, 12), "no rod", contact)
        browser.click(box[0] + x, box[1] + y)
        check(shown.run("cannonpile.view.chosen.contact") == contact, contact)
        judge_contact(shown, contact, exact, newtons)
    # The header has the number of tensile contacts, and the button finds them.
    pulling = sum(Fraction(force) < 0 for force in exact.values())
    check(f"In {pulling} contacts" in shown.run("document.getElementById('verdict').textContent"), pulling)
    met = set()
    for _ in range(pulling):
        shown.run("document.getElementById('seek-pulls').click()")
        contact = shown.run("cannonpile.view.chosen.contact")
        check(Fraction(judge_contact(shown, contact, exact, newtons)) < 0, contact)
        check("pulls" in shown.run("document.querySelector('#chosen .mark').textContent"), contact)
        met.add(contact)
    check(len(met) == pulling, met)
    for button, extreme in [("greatest", max), ("least", min)]:
        shown.run(f"document.getElementById('seek-{button}').click()")
        force = judge_contact(shown, shown.run("cannonpile.view.chosen.contact"), exact, newtons)
        check(Fraction(force) == extreme(Fraction(x) for x in exact.values()), button, force)
    shown.quiet()
    return f"{len(found)} rods by pointer, {pulling} that pull by button"


def judge_contact(shown, contact, exact, newtons, state=0):
    place = shown.run(f"cannonpile.pile.place(cannonpile.pile.ends[0][{contact}])").split(",")
    way = shown.run(f"cannonpile.pile.wayNames[cannonpile.pile.wayOf[{contact}]]")
    found = row_numbers(shown.rows()[state])
    check(found == [exact[*place, way], newtons[*place, way]], contact, found, exact[*place, way])
    return found[0]


def cut_takes_layers_off(browser):
    shown = Shown(browser, page("fcc", "--layers", "10"))
    shown.run("document.getElementById('front').click()")
    x, y = shown.at(1)
    ground = shown.run("cannonpile.view.theme().ground.map((part) => Math.round(255 * part))")
    pixel = lambda: browser.picture().getpixel((round(x), round(y)))
    check(not near(pixel(), ground, 20), "no apex")
    cut(shown, "from", 5)
    browser.picture(folder / "cut.png")
    check(near(pixel(), ground, 3), "the apex is still there")
    browser.click(x, y)
    check(shown.heading() == "No selection", "what was cut off is picked")
    # Selecting a hidden sphere by number shows its layer. Keys change the visible layers too.
    shown.run("document.getElementById('sphere').value = '1'; document.getElementById('find').requestSubmit()")
    check(shown.run("cannonpile.view.layers[0]") == 0 and not near(pixel(), ground, 20), "not shown again")
    shown.run("document.getElementById('picture').focus()")
    browser.press("]")
    check(shown.run("document.getElementById('cut-says').textContent") == "k = 1 to 9", "the key ] does not cut")
    browser.press("[")
    # Rotation and zoom by pointer and by key.
    before = shown.at(100)
    browser.drag((400, 300), (470, 330))
    turned = shown.at(100)
    check(abs(before[0] - turned[0]) > 3, "a drag does not turn")
    browser.press("+")
    check(shown.at(100) != turned, "the key + does not zoom")
    browser.press("ArrowLeft")
    shown.quiet()
    return "layers by slider and by key"


def both_states_are_shown(browser):
    scene = ["--stacking=+-+-+", "--state", "elastic"]
    exact, newtons = forces(*scene)
    isostatic, of_isostatic = forces("--stacking=+-+-+", "--spacing", "1")
    shown = Shown(browser, page("elastic", *scene))
    labels = shown.run("[...document.querySelectorAll('#labels span')].map((label) => label.textContent)")
    check(labels == ["isostatic", "elastic"], labels)
    for state in [0, 1]:
        shown.run("cannonpile.choose({}) || 0")
        browser.click(*shown.at(1, state))
        check(shown.heading() == "Sphere 1 (0,0,0)", state, shown.heading())
    sloping, pushing = 0, 0
    for shown_table in shown.spheres("Array.from({ length: cannonpile.pile.firstOnFloor - 1 }, (_, n) => n + 1)"):
        sloping += judge_sphere(shown_table, isostatic, of_isostatic, state=0, states=2)
        pushing += judge_sphere(shown_table, exact, newtons, state=1, states=2)
    check(pushing == sloping + 2 * (len(exact) - len(isostatic)) and len(exact) == len(isostatic) + 3, sloping, pushing)
    # Three horizontal contacts have a force, and the others are open.
    shown.run("document.getElementById('show-forces').click(); cannonpile.choose({ sphere: cannonpile.pile.find('2,0,-1') })")
    beside = [row for row in shown.rows() if row["head"].startswith("beside")]
    wanted = exact["2", "0", "-1", "alpha-beta"]
    check(sum(row_numbers(row, 1, 2)[0] == wanted for row in beside) == 1, beside, wanted)
    check("open" in shown.run("document.getElementById('chosen').textContent"), "nothing is open")
    browser.picture(folder / "elastic.png")
    check(any(isostatic[key] != exact[key] for key in isostatic), "one state only")
    shown.quiet()
    return "isostatic and elastic state"


def dark_and_small(browser):
    scene = ["--weightless", "--load", "0,0,0=1", "--top", "hexagon:5", "--stacking", "hcp", "--layers", "5"]
    path = page("response", *scene)
    shown = Shown(browser, path, dark=True)
    picture = browser.picture(folder / "dark.png")
    check(max(picture.getpixel((3, 3))) < 60, "the page is not dark")
    box = shown.run("(({ left, top }) => [left, top])(document.getElementById('picture').getBoundingClientRect())")
    check(max(picture.getpixel((round(box[0] + 6), round(box[1] + 6)))) < 60, "the picture is not dark")
    shown.quiet()
    shown = Shown(browser, path, size=PHONE, scale=2, touch=True)
    wide = shown.run("[document.documentElement.scrollWidth, innerWidth]")
    check(wide[0] <= wide[1], "a phone has to scroll horizontally", wide)
    shown.run("document.getElementById('above').click()")
    loaded = shown.run("cannonpile.pile.find('0,0,0')")
    x, y = shown.at(loaded)
    browser.touch([(x, y)])
    check(shown.run("cannonpile.view.chosen.sphere") == loaded, "a tap does not choose")
    distance = shown.run("cannonpile.view.camera.distance")
    browser.touch([(x - 20, y), (x + 20, y)], [(x - 40, y), (x + 40, y)], [(x - 60, y), (x + 60, y)])
    check(shown.run("cannonpile.view.camera.distance") < 0.6 * distance, "a pinch does not zoom")
    browser.picture(folder / "phone.png")
    shown.quiet()
    return "dark, and on a phone"


def without_webgl(path):
    """Checks that the table works without WebGL2."""
    with Browser("--disable-gpu", "--disable-webgl", "--disable-3d-apis") as browser:
        browser.show(*SCREEN)
        browser.open(path)
        check(not browser.run("document.getElementById('undrawn').hidden"), "no word on what is missing")
        browser.run("document.getElementById('sphere').value = '1'; document.getElementById('find').requestSubmit()")
        check(browser.run("document.querySelectorAll('#chosen tbody tr').length") > 3, "no table")
        check(browser.requests[-1].startswith("file:///"), browser.requests)
        browser.picture(folder / "undrawn.png")
    return "without WebGL2 a table"


def texts_are_no_markup(browser):
    """Checks that markup in the data is displayed as text."""
    path = page("plain", "--layers", "3")
    planted = folder / "planted.html"
    page_text = path.read_text()
    check("A pile of 10 spheres in 3 layers" in page_text, "no title")
    markup = "\\u003c/script>\\u003cimg src=x onerror=alert(1)>\\u003cscript>throw 1\\u003c/script>"
    planted.write_text(page_text.replace("A pile of 10 spheres in 3 layers", markup))
    shown = Shown(browser, planted)
    check("<img src=x" in shown.run("document.getElementById('title').textContent"), "the title is not shown as it is")
    check(shown.run("document.images.length") == 0, "a picture was made of a text")
    shown.quiet()
    # The content security policy blocks other scripts and all requests.
    planted.write_text(page_text.replace("</body>", "<script>globalThis.ran = 1</script><img src='https://example.org/'></body>"))
    shown = Shown(browser, planted)
    check(shown.run("globalThis.ran === undefined"), "another script has run")
    refused = " ".join(browser.errors)
    check("Executing inline script violates" in refused and "Loading the image" in refused, "the policy does not hold", refused)
    return "texts stay texts"


def many_spheres(browser):
    begun = time.monotonic()
    path = page("many", "--layers", "83")
    written = time.monotonic() - begun
    shown = Shown(browser, path)
    count = shown.run("cannonpile.pile.count")
    begun = time.monotonic()
    for _ in range(5):
        shown.run("cannonpile.view.camera.turn(0.1, 0); cannonpile.view.redraw()")
        browser.picture()
    frame = (time.monotonic() - begun) / 5
    begun = time.monotonic()
    browser.click(*shown.at(98000))
    picked = time.monotonic() - begun
    browser.picture(folder / "many.png")
    shown.quiet()
    size = path.stat().st_size
    return f"{count} spheres: {size} bytes written in {written:.2f} s, opened in {shown.seconds:.1f} s, turned in {frame:.2f} s, chosen in {picked:.2f} s"


def main():
    with Browser() as browser:
        for test in [draws_and_picks, contacts_are_picked, cut_takes_layers_off, both_states_are_shown, dark_and_small, texts_are_no_markup, many_spheres]:
            begun = time.monotonic()
            summary = test(browser)
            print(f"{test.__name__}: {summary} ({time.monotonic() - begun:.1f} s)", flush=True)
    print(f"without_webgl: {without_webgl(folder / 'hcp.html')}")


main()
