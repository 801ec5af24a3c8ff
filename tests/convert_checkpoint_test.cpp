// The script that converts checkpoints of PyTorch, on small ones that PyTorch wrote.
#include "tests/run_program.h"
#include "tools/learning/crig_config.h"
#include "tools/learning/safetensors.h"

#include <doctest/doctest.h>

using namespace pluvia;

namespace {

/// Runs python3, which Debian's python3-torch belongs to; false when it fails.
bool python(const std::string& arguments) {
    return std::system(("/usr/bin/python3 -W ignore " + arguments + " >/dev/null 2>&1").c_str()) == 0;
}

bool convert(const std::string& arguments) {
    return python(std::string(PLUVIA_SOURCE_DIR) + "/tools/learning/convert_checkpoint.py " + arguments);
}

constexpr const char* make_checkpoints = R"(
import sys, torch
folder = sys.argv[1]
def tensors(*names): return {n: torch.full((2, 3), float(i)) for i, n in enumerate(names)}
u, d = "model.diffusion_model.", "model_ema.diffusion_model"
hrig = tensors(u + "out.2.weight", "first_stage_model.encoder.conv_in.weight", "gdm." + u + "out.2.weight",
               "cond_stage_model.encoder.conv_in.weight", "betas")
hrig[d + "out2weight"] = torch.full((2, 3), 7.0)
torch.save({"state_dict": hrig, "epoch": 98}, folder + "/hrig.ckpt")
torch.save(dict(hrig, **{u + "middle_block.1.transformer_blocks.0.attn2.to_k.weight": torch.zeros(1),
                         d + "middle_block1transformer_blocks0attn2to_kweight": torch.zeros(1)}), folder + "/guided.ckpt")
torch.save(tensors("encoder.x.weight", "decoder.init.init.0.weight_orig", "decoder.init.init.1.num_batches_tracked"),
           folder + "/crig.pt")
torch.save(tensors("features.0.weight", "classifier.1.weight"), folder + "/alex.pth")
torch.save(tensors("lin0.model.1.weight"), folder + "/heads.pth")
torch.save(tensors("Mixed_7c.branch_pool.conv.weight", "fc.weight"), folder + "/fid.pth")
)";

}  // namespace

TEST_CASE("checkpoints become files of weights with what inference needs of them, under their own names") {
    if (!python("-c 'import torch'")) {
        MESSAGE("skipped: python3-torch is missing");
        return;
    }
    const TemporaryFolder folder;
    write_file(folder / "make.py", make_checkpoints);
    REQUIRE(python((folder / "make.py") + " " + folder.path()));
    const auto names = [&](const std::string& checkpoints, const std::string& options = "") {
        std::string arguments = options + " -o " + (folder / "out");
        for (size_t at = 0, end; at < checkpoints.size(); at = end + 1) {
            end = std::min(checkpoints.find(' ', at), checkpoints.size());
            arguments += " " + (folder / checkpoints.substr(at, end - at));
        }
        REQUIRE(convert(arguments));
        std::vector<std::string> list;
        const SafetensorsFile file(folder / "out");
        for (const auto& [name, entry] : file.entries()) list.push_back(name);
        return list;
    };
    using Names = std::vector<std::string>;
    const std::string unet = "model.diffusion_model.out.2.weight", stage = "first_stage_model.encoder.conv_in.weight";
    CHECK(names("hrig.ckpt") == Names{stage, unet});
    std::vector<float> values(6);
    SafetensorsFile(folder / "out").read(unet, values);
    CHECK(values[0] == 7);  // the running mean
    CHECK(names("hrig.ckpt", "--weights raw") == Names{stage, unet});
    SafetensorsFile(folder / "out").read(unet, values);
    CHECK(values[0] == 0);
    CHECK(names("guided.ckpt").size() == 4);  // the guiding model, too
    CHECK(names("crig.pt") == Names{"decoder.init.init.0.weight_orig"});
    CHECK(is_crig(SafetensorsFile(folder / "out")));
    CHECK(names("alex.pth heads.pth") == Names{"features.0.weight", "lin0.model.1.weight"});
    CHECK(names("fid.pth") == Names{"Mixed_7c.branch_pool.conv.weight"});
    CHECK_FALSE(convert((folder / "alex.pth") + " -o " + (folder / "no")));  // without its heads
    CHECK_FALSE(std::filesystem::exists(folder / "no"));
}
