"""What is wrong with the pages of the site that was built: links, anchors, pictures, equations."""
import html.parser
import json
import pathlib
import shutil
import subprocess
import urllib.parse

# KaTeX reads every equation, and equations that it cannot read are reported. stdin: [[page, tex, display], …]
EQUATIONS = """
const katex = require(process.argv[1]);
for (const [page, tex, displayMode] of JSON.parse(require("fs").readFileSync(0, "utf8"))) {
  try {
    katex.renderToString(tex, { displayMode, throwOnError: true, strict: "ignore" });
  } catch (fault) {
    console.log(`${page}: ${fault.message}`);
  }
}
"""


class Page(html.parser.HTMLParser):
    """A page's anchors, what it refers to, and its equations."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.targets, self.equations, self.open = set(), [], [], False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.anchors |= {attributes.get("id"), attributes.get("name")}
        self.targets += [attributes[key] for key in ("href", "src") if attributes.get(key)]
        kinds = (attributes.get("class") or "").split()
        self.open = "tex" in kinds
        if self.open:
            self.equations.append(["", "display" in kinds])

    def handle_endtag(self, tag):
        self.open = False

    def handle_data(self, data):
        if self.open:
            self.equations[-1][0] += data


def problems_of_links(pages):
    for path, page in pages.items():
        for target in page.targets:
            url = urllib.parse.urlparse(target)
            if url.scheme or url.netloc:
                continue
            file = (path.parent / urllib.parse.unquote(url.path)).resolve() if url.path else path
            if not file.exists():
                yield f"{path.name}: {target} does not exist"
            elif url.fragment and file in pages and urllib.parse.unquote(url.fragment) not in pages[file].anchors:
                yield f"{path.name}: {target}: no such anchor"


def problems_of_equations(folder, pages):
    equations = [[path.name, tex, display] for path, page in pages.items() for tex, display in page.equations]
    if not equations or not shutil.which("node"):
        return []
    run = subprocess.run(["node", "-e", EQUATIONS, folder / "_static/katex/katex.min.js"],
                         input=json.dumps(equations), capture_output=True, text=True, check=True)
    return run.stdout.splitlines()


def problems_of(folder):
    """What a reader of the site would miss, a line each."""
    folder = pathlib.Path(folder).resolve()
    own = folder / "_static/try.html"  # the page with the simulator: a program, not a page of the documentation
    pages = {path: Page(path.read_text()) for path in sorted(folder.rglob("*.html")) if path != own}
    return sorted(set(problems_of_links(pages))) + problems_of_equations(folder, pages)
