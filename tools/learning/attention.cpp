#include "tools/learning/attention.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr int64_t max_scores = 16 << 20;  // floats at a time: 64 MiB, twice for softmax

/// [batch, cells, heads * width] to [batch * heads, width, cells].
at::Tensor split_heads(const at::Tensor& x, int64_t width) {
    const int64_t heads = x.size(2) / width;
    return x.reshape({x.size(0), x.size(1), heads, width}).permute({0, 2, 3, 1}).reshape({-1, width, x.size(1)});
}

}  // namespace

at::Tensor attend(const at::Tensor& q, const at::Tensor& k, const at::Tensor& v, double scale) {
    // Half of the scale on either side keeps large products out of the scores.
    const double half = std::sqrt(scale);
    const at::Tensor queries = q.transpose(1, 2) * half, keys = k * half, values = v.transpose(1, 2);
    const int64_t count = queries.size(1);
    const int64_t block = std::clamp<int64_t>(max_scores / std::max<int64_t>(1, q.size(0) * k.size(2)), 1, count);
    std::vector<at::Tensor> parts;
    for (int64_t first = 0; first < count; first += block) {
        const int64_t n = std::min(block, count - first);
        parts.push_back(at::bmm(at::softmax(at::bmm(queries.narrow(1, first, n), keys), -1), values));
    }
    return at::cat(parts, 1).transpose(1, 2);
}

HeadAttention::HeadAttention(const Parameters& p, int64_t channels, int64_t head_width_)
    : norm(p.part("norm"), channels, 1e-5),
      qkv_weight(p.part("qkv").get("weight", {3 * channels, channels, 1}, {Start::uniform, channels})),
      qkv_bias(p.part("qkv").get("bias", {3 * channels}, {Start::uniform, channels})),
      out_weight(p.part("proj_out").get("weight", {channels, channels, 1}, {Start::uniform, channels, true})),
      out_bias(p.part("proj_out").get("bias", {channels}, {Start::uniform, channels, true})),
      head_width(head_width_) {}

at::Tensor HeadAttention::operator()(const at::Tensor& x) const {
    const int64_t batch = x.size(0), channels = x.size(1);
    const at::Tensor flat = x.reshape({batch, channels, -1});
    const at::Tensor qkv = at::conv1d(norm(flat), qkv_weight, qkv_bias).reshape({-1, 3 * head_width, flat.size(2)});
    const at::Tensor heads = attend(qkv.narrow(1, 0, head_width), qkv.narrow(1, head_width, head_width),
                                    qkv.narrow(1, 2 * head_width, head_width), 1 / std::sqrt(double(head_width)));
    return x + at::conv1d(heads.reshape({batch, channels, -1}), out_weight, out_bias).reshape_as(x);
}

CellAttention::CellAttention(const Parameters& p, int64_t channels)
    : norm(p.part("norm"), channels, 1e-6),
      q(p.part("q"), channels, channels, 1),
      k(p.part("k"), channels, channels, 1),
      v(p.part("v"), channels, channels, 1),
      out(p.part("proj_out"), channels, channels, 1) {}

at::Tensor CellAttention::operator()(const at::Tensor& x) const {
    const at::Tensor h = norm(x);
    const auto flat = [&](const Convolution& c) { return c(h).flatten(2); };
    return x + out(attend(flat(q), flat(k), flat(v), 1 / std::sqrt(double(x.size(1)))).reshape_as(x));
}

GuidedAttention::Projections::Projections(const Parameters& p, int64_t channels, int64_t context_channels)
    : q(p.part("to_q"), channels, channels, false),
      k(p.part("to_k"), context_channels, channels, false),
      v(p.part("to_v"), context_channels, channels, false),
      out(p.part("to_out").part(0), channels, channels) {}

GuidedAttention::LayerNorm::LayerNorm(const Parameters& p, int64_t channels)
    : weight(p.get("weight", {channels}, {Start::one})), bias(p.get("bias", {channels}, {Start::zero})) {}

at::Tensor GuidedAttention::LayerNorm::operator()(const at::Tensor& x) const {
    return at::layer_norm(x, {x.size(-1)}, weight, bias, 1e-5);
}

GuidedAttention::GuidedAttention(const Parameters& p, int64_t channels, int64_t head_width, int64_t context_channels)
    : head_width_(head_width),
      norm_(p.part("norm"), channels, 1e-6),
      in_(p.part("proj_in"), channels, channels, 1),
      self_(p.part("transformer_blocks.0.attn1"), channels, channels),
      guide_(p.part("transformer_blocks.0.attn2"), channels, context_channels),
      gate_(p.part("transformer_blocks.0.ff.net.0.proj"), channels, 8 * channels),
      back_(p.part("transformer_blocks.0.ff.net.2"), 4 * channels, channels),
      norm1_(p.part("transformer_blocks.0.norm1"), channels),
      norm2_(p.part("transformer_blocks.0.norm2"), channels),
      norm3_(p.part("transformer_blocks.0.norm3"), channels),
      out_(p.part("proj_out"), channels, channels, 1, 1, 0, true) {}

at::Tensor GuidedAttention::attend_heads(const Projections& p, const at::Tensor& x, const at::Tensor& context) const {
    const at::Tensor heads = attend(split_heads(p.q(x), head_width_), split_heads(p.k(context), head_width_),
                                    split_heads(p.v(context), head_width_), 1 / std::sqrt(double(head_width_)));
    return p.out(heads.reshape({x.size(0), -1, x.size(1)}).transpose(1, 2));
}

at::Tensor GuidedAttention::operator()(const at::Tensor& x, const at::Tensor& context) const {
    at::Tensor h = in_(norm_(x)).flatten(2).transpose(1, 2);  // [batch, cells, channels]
    const at::Tensor own = norm1_(h);
    h = h + attend_heads(self_, own, own);
    h = h + attend_heads(guide_, norm2_(h), context);
    const std::vector<at::Tensor> gate = gate_(norm3_(h)).chunk(2, -1);
    h = h + back_(gate[0] * at::gelu(gate[1]));
    return x + out_(h.transpose(1, 2).reshape_as(x));
}

}  // namespace pluvia
