"""The interactive page of a pile. Browser tests are separate."""

import html
import re
from html.parser import HTMLParser

import pytest

from cannonpile import Pile


class Elements(HTMLParser):
    """The elements of a page and the resources that they load."""

    def __init__(self, text):
        super().__init__()
        self.names, self.loaded = [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.names.append(tag)
        self.loaded += [
            value for name, value in attrs if name in ("src", "href", "action") and not value.startswith(("#", "data:"))
        ]


def test_page_is_one_document():
    page = Pile(4, "hcp", top="hexagon:3").show()
    elements = Elements(page.html)
    assert page.html.startswith("<!doctype html>") and elements.names.count("html") == 1
    assert {"canvas", "script", "style", "title"} <= set(elements.names)
    # It loads no external resources.
    assert elements.loaded == []
    assert not re.search(r"https?://", page.html)
    assert str(page) == page.html


def test_page_is_of_this_pile():
    assert Pile(4).show().html == Pile(4).show().html
    assert Pile(4).show().html != Pile(5).show().html
    assert Pile(4).show().html != Pile(4, gravity="9.81").show().html


def test_page_in_a_notebook():
    page = Pile(4).show()
    [document] = re.findall(r'srcdoc="([^"]*)"', page._repr_html_())
    assert html.unescape(document) == page.html
    assert Elements(page._repr_html_()).names == ["iframe"]


def test_page_as_a_file(tmp_path):
    pile = Pile(5, "hcp", loads={(0, 0, 0): "5/2"})
    pile.show().save(tmp_path / "page.html")
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == pile.show().html
    # The file of export is the same.
    names = pile.export(tmp_path / "pile", "html")
    [name] = [name for name in names if name.endswith(".html")]
    assert (tmp_path / "pile" / name).read_text(encoding="utf-8") == pile.show().html


def test_page_of_too_many_spheres():
    with pytest.raises(ValueError, match="100000|100,000|10\\^5"):
        Pile(90).show()
