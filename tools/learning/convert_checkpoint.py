#!/usr/bin/env python3
"""Turns a checkpoint of HRIGNet or of latent diffusion (.ckpt, PyTorch Lightning) into weights for `pluvia learn`.

    apt-get install python3-torch
    tools/learning/convert_checkpoint.py last.ckpt model.safetensors --weights ema

A .ckpt is a pickle, which can run any code while it is read: convert only files whose origin you trust. Kept are the
UNet, the first stage, and the guiding model where the UNet looks at it; names stay those of the checkpoint. EMA weights
take the place of those they are the mean of, which is what the published scripts do for the main UNet only.
"""
import argparse
import json
import struct
import sys

UNET = "model.diffusion_model."
STAGE = "first_stage_model."
GUIDE = "gdm." + UNET


def ema_name(name):
    """The name under which a running mean is kept: without its dots, so that it can be built but not taken apart."""
    return "model_ema." + name[len("model."):].replace(".", "")


def choose(state, weights):
    """Names and tensors that inference needs."""
    guided = any(name.startswith(UNET) and ".attn2." in name for name in state)
    kept = {}
    for name, tensor in state.items():
        if name.startswith(UNET):
            mean = ema_name(name)
            if weights == "ema" and mean not in state:
                sys.exit(f"convert_checkpoint: {name} has no mean {mean}; use --weights raw")
            kept[name] = state[mean] if weights == "ema" else tensor
        elif name.startswith(STAGE) and name[len(STAGE):].split(".")[0] in (
                "encoder", "decoder", "quant_conv", "post_quant_conv", "quantize"):
            kept[name] = tensor
        elif guided and name.startswith(GUIDE):
            kept[name] = tensor
    return kept


def write(path, tensors, metadata, half):
    import numpy as np

    header, offset = {"__metadata__": metadata}, 0
    dtype, kind = ("F16", "<f2") if half else ("F32", "<f4")
    for name, tensor in tensors.items():
        size = tensor.numel() * (2 if half else 4)
        header[name] = {"dtype": dtype, "shape": list(tensor.shape), "data_offsets": [offset, offset + size]}
        offset += size
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 8)
    with open(path, "wb") as file:
        file.write(struct.pack("<Q", len(text)) + text)
        for tensor in tensors.values():
            file.write(np.ascontiguousarray(tensor.float().numpy(), dtype=kind).tobytes())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkpoint")
    parser.add_argument("output")
    parser.add_argument("--weights", choices=("ema", "raw"), default="ema")
    parser.add_argument("--half", action="store_true", help="16 bits a value")
    parser.add_argument("--head-width", type=int, default=32, help="channels of an attention head of the UNet")
    options = parser.parse_args()
    import torch

    state = torch.load(options.checkpoint, map_location="cpu")
    tensors = choose(state.get("state_dict", state), options.weights)
    if not any(name.startswith(UNET) for name in tensors):
        sys.exit("convert_checkpoint: there is no UNet in this file")
    settings = {"kind": "diffusion", "head_width": options.head_width, "times": 1000, "first_beta": 0.0015,
                "last_beta": 0.0195}
    write(options.output, tensors, {"pluvia": json.dumps(settings), "weights": options.weights}, options.half)
    print(f"{options.output}: {len(tensors)} tensors, {sum(t.numel() for t in tensors.values())} values")


if __name__ == "__main__":
    main()
