"""`python -m codegen`: writes the files of src/loiter/native that are generated."""

from codegen.files import FOLDER, files

if __name__ == "__main__":
    for name, text in files().items():
        (FOLDER / name).write_text(text, encoding="utf-8")
