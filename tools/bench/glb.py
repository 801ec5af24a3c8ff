"""A .glb file as its JSON and its binary chunk, for scripts that change a scene before two programs render it."""
import json
import os
import struct
import sys

JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942


def read_glb(path):
    """The file's JSON as a dictionary, and its binary chunk."""
    try:
        with open(path, "rb") as file:
            data = file.read()
    except OSError as error:
        sys.exit(f"glb: {path}: cannot be read ({error.strerror})")
    if len(data) < 20 or struct.unpack_from("<4sI", data) != (b"glTF", 2):
        sys.exit(f"glb: {path}: is no .glb file of version 2")
    length, kind = struct.unpack_from("<II", data, 12)
    if kind != JSON_CHUNK:
        sys.exit(f"glb: {path}: does not begin with JSON")
    root = json.loads(data[20 : 20 + length])
    if any("uri" in buffer for buffer in root.get("buffers", [])):
        sys.exit(f"glb: {path}: keeps data outside of the file (expected all of it inside)")
    return root, bytearray(data[20 + length + 8 :])


def write_glb(path, root, binary):
    """Writes what read_glb gives; the file appears whole."""
    binary = bytes(binary) + b"\0" * (-len(binary) % 4)
    root["buffers"] = [{"byteLength": len(binary)}]
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    with open(path + ".tmp", "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<II", len(text), JSON_CHUNK) + text)
        file.write(struct.pack("<II", len(binary), BINARY_CHUNK) + binary)
    os.replace(path + ".tmp", path)
