#!/usr/bin/env python3
"""Turns checkpoints of PyTorch (.ckpt, .pt, .pth) into weights for `pluvia learn`.

    apt-get install python3-torch
    tools/learning/convert_checkpoint.py last.ckpt -o model.safetensors             # HRIGNet, latent diffusion
    tools/learning/convert_checkpoint.py ED_state_500.pt -o crig.safetensors        # CRIGNet
    tools/learning/convert_checkpoint.py alexnet-owt-7be5be79.pth alex.pth -o lpips.safetensors
    tools/learning/convert_checkpoint.py pt_inception-2015-12-05-6726825d.pth -o fid.safetensors

A checkpoint is a pickle, which can run any code while it is read: convert only files whose origin you trust. What it
holds, its names tell. Kept of HRIGNet are the UNet, the first stage, and the guiding model where the UNet looks at it;
of CRIGNet the generator; for LPIPS, AlexNet's or VGG16's features (torchvision) and the linear heads (lpips), from two
files; for FID, the network of pytorch-fid. Names stay those of the checkpoint. EMA weights take the place of those they
are the mean of, which is what the published scripts do for the main UNet only.
"""
import argparse
import json
import struct
import sys

UNET = "model.diffusion_model."
STAGE = "first_stage_model."
GUIDE = "gdm." + UNET
CRIG = "decoder."
LPIPS = ("features.", "lin")
FID = ("Conv2d_", "Mixed_")


def ema_name(name):
    """The name under which a running mean is kept: without its dots, so that it can be built but not taken apart."""
    return "model_ema." + name[len("model."):].replace(".", "")


def choose(state, weights):
    """Names and tensors that inference needs, and what the file then is."""
    state = {name: tensor for name, tensor in state.items() if not name.endswith("num_batches_tracked")}

    def starting(*prefixes):
        return {name: tensor for name, tensor in state.items() if name.startswith(prefixes)}

    if CRIG + "init.init.0.weight_orig" in state:
        return starting(CRIG), {"kind": "crig"}
    if "features.0.weight" in state:
        if "lin0.model.1.weight" not in state:
            sys.exit("convert_checkpoint: LPIPS needs its linear heads, too: name the file of lpips beside this one")
        return starting(*LPIPS), {"kind": "lpips"}
    if "Mixed_7c.branch_pool.conv.weight" in state:
        return starting(*FID), {"kind": "fid"}
    if not starting(UNET):
        sys.exit("convert_checkpoint: this file holds none of the networks that `pluvia learn` knows")
    return choose_diffusion(state, weights), {"kind": "diffusion"}


def choose_diffusion(state, weights):
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
    parser.add_argument("checkpoints", nargs="+")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--weights", choices=("ema", "raw"), default="ema")
    parser.add_argument("--half", action="store_true", help="16 bits a value")
    parser.add_argument("--head-width", type=int, default=32, help="channels of an attention head of the UNet")
    options = parser.parse_args()
    import torch

    state = {}
    for path in options.checkpoints:
        loaded = torch.load(path, map_location="cpu")
        state.update(loaded.get("state_dict", loaded))
    tensors, settings = choose(state, options.weights)
    metadata = {}
    if settings["kind"] == "diffusion":
        settings.update({"head_width": options.head_width, "times": 1000, "first_beta": 0.0015, "last_beta": 0.0195})
        metadata["weights"] = options.weights
    metadata["pluvia"] = json.dumps(settings)
    write(options.output, tensors, metadata, options.half)
    print(f"{options.output}: {len(tensors)} tensors, {sum(t.numel() for t in tensors.values())} values")


if __name__ == "__main__":
    main()
