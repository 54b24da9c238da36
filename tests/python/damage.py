"""Damage as files meet it on disks, by transfer and by editors: of a folder, one file at a time, repeatable by its
seed."""
import os
import random
import re
import shutil

NOT_DATA = {".polynya"}


def data_files(folder):
    """The files of a folder that commands read, and those of the folders in it, in a fixed order."""
    found = sorted(path for path in folder.rglob("*") if path.is_file() and path.name not in NOT_DATA)
    return [path for path in found if path.suffix not in (".svg", ".png", ".html", ".pdf")]


def flip_bit(dice, data):
    at = dice.randrange(len(data))
    return data[:at] + bytes([data[at] ^ 1 << dice.randrange(8)]) + data[at + 1 :]


def other_byte(dice, data):
    at = dice.randrange(len(data))
    return data[:at] + bytes([dice.randrange(256)]) + data[at + 1 :]


def truncated(dice, data):
    return data[: dice.randrange(len(data))]


def latin_1(dice, data):
    at = dice.randrange(len(data))
    return data[:at] + "Sør".encode("latin-1") + data[at:]


def another_number(dice, data):
    """One of the numbers becomes one that files should not have."""
    places = list(re.finditer(rb"(?<![\w.])-?\d+(\.\d+)?([eE][-+]?\d+)?(?![\w.])", data))
    if not places:
        return flip_bit(dice, data)
    found = dice.choice(places)
    word = dice.choice([b"1e999", b"-1e999", b"NaN", b"nan", b"Infinity", b"-inf", b"null", b"", b'"1"', b"1_000",
                        b"0x10", b"1e308", b"-1e308", b"-1", b"0", b"1.5", b"9" * 30, b"9" * 5000, b"[]", b"{}"])
    return data[: found.start()] + word + data[found.end() :]


def long_line(dice, data):
    at = dice.randrange(len(data))
    return data[:at] + dice.choice([b"x", b"1", b",", b'"', b"["]) * 140_000 + data[at:]


def lost_line(dice, data):
    lines = data.split(b"\n")
    del lines[dice.randrange(len(lines))]
    return b"\n".join(lines)


def twice_a_line(dice, data):
    lines = data.split(b"\n")
    at = dice.randrange(len(lines))
    return b"\n".join([*lines[: at + 1], *lines[at:]])


def another_word(dice, data):
    """One of the words, a key or a name, becomes another."""
    places = list(re.finditer(rb"[A-Za-z_]{3,}", data[:200_000]))
    if not places:
        return other_byte(dice, data)
    found = dice.choice(places)
    word = dice.choice([b"x" + found[0], found[0][:-1], found[0] * 2, b"", "ü".encode(), b"\0", b"\r"])
    return data[: found.start()] + word + data[found.end() :]


CONTENTS = (flip_bit, other_byte, truncated, latin_1, another_number, long_line, lost_line, twice_a_line, another_word)


def missing(path):
    path.unlink()


def empty(path):
    path.write_bytes(b"")


def pipe(path):
    path.unlink()
    os.mkfifo(path)


def folder(path):
    path.unlink()
    path.mkdir()


def unreadable(path):
    """A link to itself: for the superuser every other file can be read."""
    path.unlink()
    path.symlink_to(path.name)


def null_device(path):
    path.unlink()
    path.symlink_to("/dev/null")


PLACES = (missing, empty, pipe, folder, unreadable, null_device)


def damaged(whole, target, seed):
    """Copies a folder and damages one of its files. Returns the file and the kind of the damage."""
    dice = random.Random(seed)
    shutil.copytree(whole, target)
    path = dice.choice(data_files(target))
    if dice.random() < 0.25:
        kind = dice.choice(PLACES)
        kind(path)
    else:
        kind = dice.choice(CONTENTS)
        data = path.read_bytes()
        path.write_bytes(kind(dice, data) if data else b"\xff")
    return path, kind.__name__
