"""`python -m codegen`: writes the files that are generated."""

from codegen.files import files

if __name__ == "__main__":
    for path, text in files().items():
        path.write_text(text, encoding="utf-8")
