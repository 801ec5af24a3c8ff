#!/usr/bin/env python3
"""Writes parity.safetensors: what small copies of the published networks answer, computed by plain PyTorch.

    apt-get install python3-torch && python3 tests/learning/parity_fixture.py tests/learning/parity.safetensors

The networks are written here from their published description (Rombach et al. 2022: vq-f4 and the UNet of latent
diffusion; Dhariwal and Nichol 2021), as functions of a dictionary of tensors. Every weight is a pure function of its
name, so that the file holds inputs and answers only, and the shape that each network asked for under each name.
"""
import json
import math
import struct
import sys

import numpy as np
import torch
import torch.nn.functional as F

MASK = (1 << 64) - 1


def mix(v):
    """Stafford's variant 13 on an array of 64-bit integers."""
    v = (v ^ (v >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    v = (v ^ (v >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return v ^ (v >> np.uint64(31))


def mix_one(v):
    return int(mix(np.array([v & MASK], dtype=np.uint64))[0])


def name_key(name):
    h = 0xCBF29CE484222325
    for c in name.encode():
        h = ((h ^ c) * 0x100000001B3) & MASK
    return h


def uniform(seed, name, count):
    """In [-1, 1), 24 bits each."""
    h = mix_one(seed + 0x9E3779B97F4A7C15)
    key = mix_one(h ^ ((name_key(name) + 0x9E3779B97F4A7C15 + ((h << 6) & MASK)) & MASK))
    bits = mix(np.arange(count, dtype=np.uint64) + np.uint64(key))
    unit = (bits >> np.uint64(40)).astype(np.float32) * np.float32(2.0**-24)
    return np.float32(2) * unit - np.float32(1)


class Weights:
    def __init__(self, seed):
        self.seed = seed
        self.shapes = {}

    def get(self, name, shape, centre=0.0, reach=0.2):
        self.shapes[name] = list(shape)
        values = uniform(self.seed, name, math.prod(shape)) * np.float32(reach) + np.float32(centre)
        return torch.from_numpy(values.astype(np.float32).reshape(shape))

    def conv(self, x, name, out, size, **kw):
        fan = x.shape[1] * size * size
        w = self.get(name + ".weight", (out, x.shape[1], size, size), reach=1 / math.sqrt(fan))
        return F.conv2d(x, w, self.get(name + ".bias", (out,), reach=1 / math.sqrt(fan)), **kw)

    def linear(self, x, name, out, bias=True):
        reach = 1 / math.sqrt(x.shape[-1])
        w = self.get(name + ".weight", (out, x.shape[-1]), reach=reach)
        return F.linear(x, w, self.get(name + ".bias", (out,), reach=reach) if bias else None)

    def norm(self, x, name, eps):
        c = x.shape[1]
        return F.group_norm(x, 32, self.get(name + ".weight", (c,), 1.0), self.get(name + ".bias", (c,)), eps)

    def layer_norm(self, x, name):
        c = x.shape[-1]
        return F.layer_norm(x, (c,), self.get(name + ".weight", (c,), 1.0), self.get(name + ".bias", (c,)))


def silu(x):
    return x * torch.sigmoid(x)


# The UNet.

def unet_res(w, x, emb, name, out):
    h = w.conv(silu(w.norm(x, name + ".in_layers.0", 1e-5)), name + ".in_layers.2", out, 3, padding=1)
    h = h + w.linear(silu(emb), name + ".emb_layers.1", out)[:, :, None, None]
    h = w.conv(silu(w.norm(h, name + ".out_layers.0", 1e-5)), name + ".out_layers.3", out, 3, padding=1)
    return h + (x if x.shape[1] == out else w.conv(x, name + ".skip_connection", out, 1))


def unet_attention(w, x, name, head):
    b, c, height, width = x.shape
    reach = 1 / math.sqrt(c)
    h = w.norm(x.reshape(b, c, -1), name + ".norm", 1e-5)
    qkv = F.conv1d(h, w.get(name + ".qkv.weight", (3 * c, c, 1), reach=reach),
                   w.get(name + ".qkv.bias", (3 * c,), reach=reach))
    answers = []
    for i in range(c // head):  # each head has its q, k and v side by side
        q, k, v = qkv[:, 3 * head * i:3 * head * (i + 1)].split(head, dim=1)
        weight = torch.softmax(torch.einsum("bct,bcs->bts", q, k) / math.sqrt(head), dim=-1)
        answers.append(torch.einsum("bts,bcs->bct", weight, v))
    out = F.conv1d(torch.cat(answers, 1), w.get(name + ".proj_out.weight", (c, c, 1), reach=reach),
                   w.get(name + ".proj_out.bias", (c,), reach=reach))
    return x + out.reshape(b, c, height, width)


def token_attention(w, x, context, name, head):
    c = x.shape[-1]
    q = w.linear(x, name + ".to_q", c, bias=False)
    k = w.linear(context, name + ".to_k", c, bias=False)
    v = w.linear(context, name + ".to_v", c, bias=False)
    answers = []
    for i in range(0, c, head):
        score = q[..., i:i + head] @ k[..., i:i + head].transpose(1, 2) / math.sqrt(head)
        answers.append(torch.softmax(score, -1) @ v[..., i:i + head])
    return w.linear(torch.cat(answers, -1), name + ".to_out.0", c)


def unet_transformer(w, x, context, name, head):
    b, c, height, width = x.shape
    h = w.conv(w.norm(x, name + ".norm", 1e-6), name + ".proj_in", c, 1)
    h = h.reshape(b, c, -1).transpose(1, 2)
    block = name + ".transformer_blocks.0"
    n = w.layer_norm(h, block + ".norm1")
    h = h + token_attention(w, n, n, block + ".attn1", head)
    h = h + token_attention(w, w.layer_norm(h, block + ".norm2"), context, block + ".attn2", head)
    value, gate = w.linear(w.layer_norm(h, block + ".norm3"), block + ".ff.net.0.proj", 8 * c).chunk(2, dim=-1)
    h = h + w.linear(value * F.gelu(gate), block + ".ff.net.2", c)
    return x + w.conv(h.transpose(1, 2).reshape(b, c, height, width), name + ".proj_out", c, 1)


def unet(w, x, t, context, channels, mult, res_blocks, factors, head, out_channels):
    def attention(h, name):
        return unet_attention(w, h, name, head) if context is None else unet_transformer(w, h, context, name, head)

    half = channels // 2
    freqs = torch.exp(-math.log(10000) * torch.arange(half, dtype=torch.float32) / half)
    angles = t[:, None].float() * freqs[None]
    emb = torch.cat([torch.cos(angles), torch.sin(angles)], dim=-1)
    emb = w.linear(silu(w.linear(emb, "time_embed.0", 4 * channels)), "time_embed.2", 4 * channels)
    h = w.conv(x, "input_blocks.0.0", channels, 3, padding=1)
    kept, n, factor = [h], 1, 1
    for level, m in enumerate(mult):
        for _ in range(res_blocks):
            h = unet_res(w, h, emb, f"input_blocks.{n}.0", m * channels)
            if factor in factors:
                h = attention(h, f"input_blocks.{n}.1")
            kept.append(h)
            n += 1
        if level + 1 < len(mult):
            h = w.conv(h, f"input_blocks.{n}.0.op", h.shape[1], 3, stride=2, padding=1)
            kept.append(h)
            n, factor = n + 1, 2 * factor
    h = unet_res(w, h, emb, "middle_block.0", h.shape[1])
    h = attention(h, "middle_block.1")
    h = unet_res(w, h, emb, "middle_block.2", h.shape[1])
    n = 0
    for level, m in reversed(list(enumerate(mult))):
        for i in range(res_blocks + 1):
            h = unet_res(w, torch.cat([h, kept.pop()], 1), emb, f"output_blocks.{n}.0", m * channels)
            part = 1
            if factor in factors:
                h = attention(h, f"output_blocks.{n}.1")
                part = 2
            if level > 0 and i == res_blocks:
                h = F.interpolate(h, scale_factor=2, mode="nearest")
                h = w.conv(h, f"output_blocks.{n}.{part}.conv", h.shape[1], 3, padding=1)
                factor //= 2
            n += 1
    return w.conv(silu(w.norm(h, "out.0", 1e-5)), "out.2", out_channels, 3, padding=1)


# The first stage.

def vq_res(w, x, name, out):
    h = w.conv(silu(w.norm(x, name + ".norm1", 1e-6)), name + ".conv1", out, 3, padding=1)
    h = w.conv(silu(w.norm(h, name + ".norm2", 1e-6)), name + ".conv2", out, 3, padding=1)
    return h + (x if x.shape[1] == out else w.conv(x, name + ".nin_shortcut", out, 1))


def vq_middle(w, x, name):
    c = x.shape[1]
    x = vq_res(w, x, name + ".block_1", c)
    h = w.norm(x, name + ".attn_1.norm", 1e-6)
    q, k, v = (w.conv(h, f"{name}.attn_1.{part}", c, 1).flatten(2) for part in "qkv")
    weight = torch.softmax(q.transpose(1, 2) @ k / math.sqrt(c), dim=2)
    x = x + w.conv((v @ weight.transpose(1, 2)).reshape(x.shape), name + ".attn_1.proj_out", c, 1)
    return vq_res(w, x, name + ".block_2", c)


def vq_encode(w, x, channels, mult, res_blocks, latent):
    h = w.conv(x, "encoder.conv_in", channels, 3, padding=1)
    for level, m in enumerate(mult):
        for block in range(res_blocks):
            h = vq_res(w, h, f"encoder.down.{level}.block.{block}", m * channels)
        if level + 1 < len(mult):
            h = w.conv(F.pad(h, (0, 1, 0, 1)), f"encoder.down.{level}.downsample.conv", h.shape[1], 3, stride=2)
    h = vq_middle(w, h, "encoder.mid")
    h = w.conv(silu(w.norm(h, "encoder.norm_out", 1e-6)), "encoder.conv_out", latent, 3, padding=1)
    return w.conv(h, "quant_conv", latent, 1)


def vq_decode(w, z, channels, mult, res_blocks, codes):
    table = w.get("quantize.embedding.weight", (codes, z.shape[1]), reach=1.0)
    distance = (z.permute(0, 2, 3, 1)[..., None, :] - table).square().sum(-1)
    z = table[distance.argmin(-1)].permute(0, 3, 1, 2)
    h = w.conv(z, "post_quant_conv", z.shape[1], 1)
    h = w.conv(h, "decoder.conv_in", channels * mult[-1], 3, padding=1)
    h = vq_middle(w, h, "decoder.mid")
    for level, m in reversed(list(enumerate(mult))):
        for block in range(res_blocks + 1):
            h = vq_res(w, h, f"decoder.up.{level}.block.{block}", m * channels)
        if level > 0:
            h = F.interpolate(h, scale_factor=2, mode="nearest")
            h = w.conv(h, f"decoder.up.{level}.upsample.conv", h.shape[1], 3, padding=1)
    return w.conv(silu(w.norm(h, "decoder.norm_out", 1e-6)), "decoder.conv_out", 3, 3, padding=1)


# DDIM.

def alphas_cumprod():
    betas = np.linspace(math.sqrt(0.0015), math.sqrt(0.0195), 1000, dtype=np.float64) ** 2
    return np.cumprod(1 - betas)


def ddim_step(x, eps, noise, t, t_before, eta):
    a, before = alphas_cumprod()[t], alphas_cumprod()[t_before]
    sigma = eta * math.sqrt((1 - before) / (1 - a)) * math.sqrt(1 - a / before)
    clean = (x - math.sqrt(1 - a) * eps) / math.sqrt(a)
    return math.sqrt(before) * clean + math.sqrt(1 - before - sigma**2) * eps + sigma * noise


def save(path, tensors, metadata):
    header, blobs, offset = {"__metadata__": metadata}, [], 0
    for name, tensor in tensors.items():
        blob = np.ascontiguousarray(tensor.numpy(), dtype="<f4").tobytes()
        header[name] = {"dtype": "F32", "shape": list(tensor.shape), "data_offsets": [offset, offset + len(blob)]}
        offset += len(blob)
        blobs.append(blob)
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 8)
    with open(path, "wb") as file:
        file.write(struct.pack("<Q", len(text)) + text + b"".join(blobs))


def main(path):
    torch.set_grad_enabled(False)
    np.seterr(over="ignore")
    generator = torch.Generator().manual_seed(7)
    out, keys = {}, {}

    def noise(*shape):
        return torch.randn(*shape, generator=generator)

    for name, tokens in (("unet", None), ("guided", 16)):
        w = Weights(11)
        x, t = noise(2, 6, 16, 8), torch.tensor([951.0, 51.0])
        context = None if tokens is None else noise(2, tokens, 3)
        if context is not None:
            out["guided.context"] = context
        out[name + ".x"], out[name + ".time"] = x, t
        out[name + ".y"] = unet(w, x, t, context, 32, (1, 2, 3), 2, (2, 4), 32, 3)
        keys[name] = json.dumps(w.shapes)

    w = Weights(13)
    x = torch.tanh(noise(1, 3, 32, 16))
    z = vq_encode(w, x, 32, (1, 2, 4), 2, 3)
    out["first_stage.x"], out["first_stage.z"] = x, z
    out["first_stage.latent"] = noise(1, 3, 8, 4)
    out["first_stage.y"] = vq_decode(w, out["first_stage.latent"], 32, (1, 2, 4), 2, 64)
    keys["first_stage"] = json.dumps(w.shapes)

    x, eps, n = noise(1, 3, 4, 4), noise(1, 3, 4, 4), noise(1, 3, 4, 4)
    out["ddim.x"], out["ddim.eps"], out["ddim.noise"] = x, eps, n
    out["ddim.first"] = ddim_step(x, eps, n, 951, 901, 1.0).float()
    last = alphas_cumprod()
    out["ddim.last"] = ddim_step(x, eps, n, 1, 0, 0.5).float()
    out["ddim.alphas"] = torch.tensor(np.array([last[0], last[500], last[999]]), dtype=torch.float32)
    save(path, out, keys)


if __name__ == "__main__":
    main(sys.argv[1])
