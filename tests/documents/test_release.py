"""What is prepared for a release says the same as the package, and is accepted by the programs that will read it."""

import json
import re
import tomllib
from pathlib import Path

import pytest
import yaml

import loiter

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
RECIPE = ROOT / "packaging" / "conda" / "recipe.yaml"
# conda-forge's names of packages that are called otherwise on the package index.
CONDA = {"matplotlib": "matplotlib-base"}


def requirement(text):
    """A requirement as the recipe writes it: "numpy >=2.0"."""
    name, bound = re.fullmatch(r"([\w-]+)(.*)", text).groups()
    return f"{CONDA.get(name, name)} {bound}".strip()


def test_the_recipe_has_the_requirements_and_the_version_of_the_package():
    recipe = yaml.safe_load(RECIPE.read_text("utf-8"))
    wanted = {requirement(text) for text in PROJECT["project"]["dependencies"]}
    assert set(recipe["requirements"]["run"]) == wanted | {"python"}
    assert set(recipe["requirements"]["host"]) == {
        "python",
        "pip",
        *(requirement(text) for text in PROJECT["build-system"]["requires"]),
    }
    assert recipe["context"]["version"] == loiter.__version__
    least = PROJECT["project"]["requires-python"].removeprefix(">=")
    assert recipe["build"]["skip"] == f'match(python, "<{least}")'


def test_the_recipe_is_rendered():
    rattler_build = pytest.importorskip(
        "rattler_build", reason="py-rattler-build, which renders the recipe, is missing"
    )
    versions = rattler_build.VariantConfig(
        {"python": ["3.11", "3.12", "3.13"], "c_compiler": ["gcc"], "c_stdlib": ["sysroot"]}
    )
    rendered = list(rattler_build.stage0.Stage0Recipe.from_file(RECIPE).render(versions))
    assert [str(one.variant["python"]) for one in rendered] == ["3.11", "3.12", "3.13"]


def test_zenodo_reads_what_the_citation_file_says():
    record = json.loads((ROOT / ".zenodo.json").read_text("utf-8"))
    assert (record["title"], record["license"]) == (CITATION["title"], CITATION["license"])
    assert record["creators"] == CITATION["authors"]
    assert {item["identifier"] for item in record["related_identifiers"]} == {
        CITATION["repository-code"],
        CITATION["references"][0]["doi"],
    }


def test_the_hosted_site_is_the_one_that_make_builds():
    settings = yaml.safe_load((ROOT / ".readthedocs.yaml").read_text("utf-8"))
    commands = settings["build"]["jobs"]["build"]["html"]
    assert commands[0].startswith("make docs ")
    assert "build/docs/" in commands[1]


def test_a_tag_publishes_only_what_the_tests_have_built():
    release = yaml.safe_load((ROOT / ".github" / "workflows" / "release.yml").read_text("utf-8"))
    tests = yaml.safe_load((ROOT / ".github" / "workflows" / "test.yml").read_text("utf-8"))
    # YAML reads the key `on` as true.
    assert "workflow_call" in tests[True]
    assert release["jobs"]["test"]["uses"] == "./.github/workflows/test.yml"
    assert release["jobs"]["publish"]["needs"] == "test"
    uploads = [
        step["with"]["name"] for step in tests["jobs"]["wheels"]["steps"] if "with" in step and "name" in step["with"]
    ]
    assert uploads == ["wheels-${{ matrix.os }}"]
