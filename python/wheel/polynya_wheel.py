"""Builds the wheel: the backend that pyproject.toml names (PEP 517). CMake compiles; this zips what came out.

    pip install .                                                  compiles in build/wheel, for the Python that runs pip
    POLYNYA_BUILD_TREE=build/release pip install .                 takes a tree that is built, for its Python

The wheel has the package, its compiled module and the program `polynya` as bin/polynya of the package, which the
console script starts (polynya/program.py), with manual page, completion and scenes. The module and the program need
the shared libraries of the machine (GMP, MPFR, TBB): the wheel's tag is linux_*, not manylinux_*.
"""
import base64
import hashlib
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAME = "polynya"
EXTRAS = {  # packages in addition to numpy, which all parts of the package need
    "plot": ["matplotlib", "scipy"],
    "tables": ["pandas", "shapely"],
    "notebook": ["matplotlib", "ipython"],
}
SUMMARY = "A geometric fracture simulator of icebreakers in ice"


def version():
    return re.search(r"^project\(polynya VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(), re.M)[1]


def tag():
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    python = "cp%d%d" % sys.version_info[:2]
    return f"{python}-{python}-{platform}"


def metadata():
    lines = ["Metadata-Version: 2.1", f"Name: {NAME}", f"Version: {version()}", f"Summary: {SUMMARY}",
             "License: GPL-3.0-or-later", "Requires-Python: >=3.9", "Requires-Dist: numpy"]
    for extra, packages in EXTRAS.items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f'Requires-Dist: {package}; extra == "{extra}"' for package in packages]
    return "\n".join(lines) + "\nDescription-Content-Type: text/markdown\n\n" + (ROOT / "README.md").read_text()


def run(*words):
    words = [str(word) for word in words]
    if subprocess.run(words, cwd=ROOT).returncode != 0:
        sys.exit(f"polynya's wheel: {' '.join(words)} failed; what it needs is installed by ./setup.sh build module")


def given_tree():
    """Path from the environment, because pip 23.0 of Debian does not pass --config-settings on."""
    return os.environ.get("POLYNYA_BUILD_TREE", "")


def built_tree():
    """The build tree to use, which must contain program and module for this Python."""
    if given_tree():
        return ROOT / given_tree()
    tree = ROOT / "build" / "wheel"
    # Forget what was found for another Python; keep the compiled rooms, which are most of the work.
    forget = ["-U", "Python_*", "-U", "_Python_*", "-U", "PYBIND11_*", "-U", "pybind11_*"]
    own = importlib.util.find_spec("pybind11")  # installed by pip for this build; otherwise Debian's headers are used
    if own:
        forget.append(f"-Dpybind11_DIR={pathlib.Path(own.origin).parent / 'share' / 'cmake' / 'pybind11'}")
    python = f"-DPython_EXECUTABLE={sys.executable}"
    run("cmake", "--preset", "release", "-B", tree, *forget, "-DPOLYNYA_PYTHON=ON", python)
    run("cmake", "--build", tree, "--target", "polynya", "polynya_core")
    return tree


def files_of_wheel(tree):
    """(name in the wheel, file) of all files that are installed, in a fixed order."""
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    module = tree / "python_core" / f"_core{suffix}"
    if not module.is_file():
        sys.exit(f"polynya's wheel: {module} is missing: POLYNYA_BUILD_TREE is of another Python than {sys.executable}")
    package = ROOT / "python" / NAME
    sources = [file for file in sorted(package.rglob("*")) if file.is_file() and "__pycache__" not in file.parts]
    files = [(f"{NAME}/{file.relative_to(package)}", file) for file in sources]
    files += [(f"{NAME}/{module.name}", module), (f"{NAME}/bin/polynya", tree / "app" / "polynya"),
              (f"{NAME}/cosim_unit/polynya.so", tree / "cosim_unit" / "polynya.so"),
              (f"{NAME}/_written_version.py", tree / "python_core" / "_written_version.py")]
    share = f"{NAME}-{version()}.data/data/share"
    files += [(f"{share}/man/man1/polynya.1", tree / "app" / "polynya.1"),
              (f"{share}/bash-completion/completions/polynya", tree / "app" / "polynya.bash")]
    return files + [(f"{share}/polynya/scenes/{file.relative_to(ROOT / 'scenes')}", file)
                    for file in sorted((ROOT / "scenes").rglob("*.json"))]


def texts_of_wheel():
    folder = f"{NAME}-{version()}.dist-info"
    return [(f"{folder}/METADATA", metadata()),
            (f"{folder}/WHEEL", f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\nTag: {tag()}\n"),
            (f"{folder}/entry_points.txt", f"[console_scripts]\npolynya = {NAME}.program:main\n"),
            (f"{folder}/LICENSE", (ROOT / "LICENSE").read_text())]


class Wheel:
    """A zip file with a list of the hashes of its files."""

    def __init__(self, path):
        self.zip = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)
        self.record = []

    def add(self, name, data, mode=0o644):
        entry = zipfile.ZipInfo(name)  # dated 1980, so that the same files give the same bytes
        entry.external_attr, entry.compress_type = (0o100000 | mode) << 16, zipfile.ZIP_DEFLATED
        self.zip.writestr(entry, data)
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        self.record.append(f"{name},sha256={digest},{len(data)}")

    def finish(self):
        name = f"{NAME}-{version()}.dist-info/RECORD"
        self.zip.writestr(zipfile.ZipInfo(name), "\n".join(self.record + [f"{name},,"]) + "\n")
        self.zip.close()


# ---- functions that pip calls

def get_requires_for_build_wheel(config_settings=None):
    """Debian's pybind11 is from 2022, before Python 3.12."""
    if given_tree() or sys.version_info < (3, 12) and pathlib.Path("/usr/include/pybind11").exists():
        return []
    return ["pybind11>=2.13"]


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    for name, text in texts_of_wheel():
        file = pathlib.Path(metadata_directory, name)
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
    return f"{NAME}-{version()}.dist-info"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    tree = built_tree()
    name = f"{NAME}-{version()}-{tag()}.whl"
    wheel = Wheel(pathlib.Path(wheel_directory, name))
    for inside, file in files_of_wheel(tree):
        wheel.add(inside, file.read_bytes(), 0o755 if os.access(file, os.X_OK) else 0o644)
    for inside, text in texts_of_wheel():
        wheel.add(inside, text.encode())
    wheel.finish()
    return name


def build_sdist(sdist_directory, config_settings=None):
    """Files of this tree that git tracks."""
    base = f"{NAME}-{version()}"
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True)
    names = listed.stdout.splitlines()
    with tarfile.open(pathlib.Path(sdist_directory, base + ".tar.gz"), "w:gz") as archive:
        for name in names:
            archive.add(ROOT / name, f"{base}/{name}")
        info = pathlib.Path(sdist_directory, "PKG-INFO")
        info.write_text(metadata())
        archive.add(info, f"{base}/PKG-INFO")
        info.unlink()
    return base + ".tar.gz"
