"""The files that are distributed, and what stands about the project in several places."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from email import message_from_bytes
from pathlib import Path

import pytest
import yaml

import loiter

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
HOME = PROJECT["project"]["urls"]["Repository"]

checkout = pytest.mark.skipif(
    shutil.which("git") is None or not (ROOT / ".git").exists(), reason="needs the list of files in git"
)


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The sdist and the wheel, built from it; by a compiler that does not optimise, which takes a fifth of the time."""
    folder = tmp_path_factory.mktemp("dist")
    compiler = tmp_path_factory.mktemp("compiler") / "cc"
    compiler.write_text('#!/bin/sh\nexec cc "$@" -O0\n')
    compiler.chmod(0o755)
    done = subprocess.run(
        [sys.executable, "-m", "build", "--no-isolation", "--outdir", folder, ROOT],
        env=os.environ | {"CC": str(compiler)},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    (sdist,), (wheel,) = folder.glob("*.tar.gz"), folder.glob("*.whl")
    return sdist, wheel


@pytest.fixture(scope="module")
def tracked():
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True)
    return set(listed.stdout.split("\n")) - {""}


@checkout
def test_the_sdist_has_every_file_of_the_project(built, tracked):
    with tarfile.open(built[0]) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert {name for name in tracked - names if not name.startswith(".ci/")} == set()
    assert {name for name in names - tracked if (ROOT / name).is_file() and not ignored(name)} <= untracked()
    assert {"conftest.py", "Makefile", "requirements/dev.txt", "benchmarks/__main__.py", "PKG-INFO"} <= names


def untracked():
    """Files that are neither in git nor ignored by it: those of somebody who works."""
    listed = subprocess.run(
        ["git", "ls-files", "--others", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return set(listed.stdout.split("\n"))


def ignored(name):
    return name == ".gitignore"


@checkout
def test_the_wheel_has_the_library_and_nothing_else(built, tracked):
    with zipfile.ZipFile(built[1]) as archive:
        names = {name for name in archive.namelist() if not re.search(r"\.(dist-info|data)/", name)}
        assert any(name.endswith(".dist-info/licenses/LICENSE") for name in archive.namelist())
    library = {name.removeprefix("src/") for name in tracked | untracked() if name.startswith("src/")}
    # Of the page it has what is built of these.
    library -= {name for name in library if name.startswith(("loiter/page/answers/", "loiter/page/source/"))}
    modules = {name for name in names if name.endswith((".so", ".pyd"))}
    assert names - modules == library
    assert {name.partition(".")[0] for name in modules} == {"loiter/compiled/loops", "loiter/compiled/single"}
    assert "loiter/py.typed" in names


def test_without_a_compiler_a_sentence_says_what_to_do():
    done = subprocess.run(
        [sys.executable, ROOT / "hatch_build.py"],
        env=os.environ | {"CC": "no-such-compiler"},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 1
    last = done.stderr.splitlines()[-1]
    assert last.startswith("loiter is built with a C compiler, and compiling failed (")
    assert "install one (on Debian: apt-get install gcc libc6-dev python3-dev), or set LOITER_PURE=1" in last
    assert "Traceback" not in done.stderr


def test_a_package_in_plain_python_is_for_every_platform(tmp_path):
    command = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", tmp_path, ROOT]
    done = subprocess.run(command, env=os.environ | {"LOITER_PURE": "1"}, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    (wheel,) = tmp_path.glob("*.whl")
    assert wheel.name.endswith("-py3-none-any.whl")
    with zipfile.ZipFile(wheel) as archive:
        assert not any(name.endswith((".so", ".pyd")) for name in archive.namelist())


def test_the_index_would_accept_the_files(built):
    pytest.importorskip("twine", reason="twine, which checks the files for the package index, is missing")
    done = subprocess.run([sys.executable, "-m", "twine", "check", "--strict", *built], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def metadata(wheel):
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        return message_from_bytes(archive.read(name))


def test_the_metadata_name_authors_addresses_and_versions(built):
    known = metadata(built[1])
    assert known["Author"] == "The loiter authors"
    assert known["Requires-Python"] == ">=3.11"
    assert known["License-Expression"] == "MIT"
    assert {line.split(", ")[0] for line in known.get_all("Project-URL")} >= {"Repository", "Documentation", "Issues"}
    classifiers = known.get_all("Classifier")
    for minor in range(11, 15):
        assert f"Programming Language :: Python :: 3.{minor}" in classifiers


def test_pictures_and_links_of_the_description_are_absolute(built):
    """In README they are relative, so that checkouts and forks show their own."""
    text = metadata(built[1]).get_payload(decode=True).decode()
    targets = re.findall(r"\]\(([^)\s]+)\)", text)
    pictures = re.findall(r"!\[[^\]]*\]\(([^)\s]+)\)", text)
    assert len(pictures) >= 2
    assert all(picture.startswith(f"{HOME}/raw/main/docs/") for picture in pictures)
    assert [target for target in targets if not target.startswith(("https://", "http://", "#"))] == []
    for target in targets:
        if target.startswith(HOME):
            assert (ROOT / target.partition("/main/")[2].partition("#")[0]).is_file(), target


def test_the_address_of_the_project_is_one():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert citation["repository-code"] == HOME
    assert citation["version"] == loiter.__version__
    assert citation["authors"] == [{"name": "The loiter authors"}]
    text = (ROOT / "pyproject.toml").read_text("utf-8")
    own = {address for address in re.findall(r"https://[^\s\"')]+", text) if "loiter" in address}
    assert [address for address in own if not address.startswith(HOME)] == []


def test_the_bibtex_of_the_readme_says_what_the_citation_file_says():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    (paper,) = citation["references"]
    people = [f"{author['family-names']}, {author['given-names']}" for author in paper["authors"]]
    expected = [
        {
            "title": citation["title"],
            "author": f"{{{citation['authors'][0]['name']}}}",
            "version": citation["version"],
            "url": citation["repository-code"],
        },
        {
            "title": paper["title"].replace("UAV", "{UAV}"),
            "author": " and ".join(people),
            **{name: str(paper[name]) for name in ("journal", "volume", "year", "doi")},
        },
    ]
    text = (ROOT / "README.md").read_text("utf-8").partition("```bibtex\n")[2].partition("```")[0]
    found = [dict(re.findall(r"(\w+)\s+= \{(.*)\}", entry)) for entry in text.split("\n\n")]
    assert found == expected


WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.name)
def test_actions_are_pinned_to_a_commit(path):
    # Those of other repositories: our own workflow is that of the same commit.
    used = re.findall(r"uses: ([^.\s]\S+)(.*)", path.read_text("utf-8"))
    assert [name for name, note in used if not (re.search(r"@[0-9a-f]{40}$", name) and re.search(r"# v\d", note))] == []


def test_every_supported_python_and_system_is_tried():
    jobs = yaml.safe_load((ROOT / ".github/workflows/test.yml").read_text("utf-8"))["jobs"]
    matrix = jobs["install"]["strategy"]["matrix"]
    assert matrix["python"] == ["3.11", "3.12", "3.13", "3.14"]
    assert [system.partition("-")[0] for system in matrix["os"]] == ["ubuntu", "macos", "windows"]


@pytest.mark.parametrize("name", ["ruff", "mypy"])
def test_the_hooks_use_the_versions_of_the_tests(name):
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text("utf-8"))["repos"]
    revisions = {hook["id"].partition("-")[0]: repo["rev"] for repo in hooks for hook in repo["hooks"]}
    pinned = re.search(rf"^{name}==(\S+)$", (ROOT / "requirements/dev.txt").read_text("utf-8"), re.MULTILINE)
    assert revisions[name] == f"v{pinned[1]}"


def test_a_bare_python_runs_the_examples_of_the_overview():
    """The script that tries wheels; with this Python."""
    done = subprocess.run(
        [sys.executable, ROOT / "tests/documents/examples.py", ROOT / "docs/overview.md"],
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert re.search(r"^(1\d|[2-9]\d) examples, 0 failed$", done.stdout, re.MULTILINE)
