// Training on a pair made by a formula: losses fall, and an interrupted training goes on as if it had not been.
#include "renderer/core/error.h"
#include "tests/temporary_folder.h"
#include "tools/learning/synthesis.h"
#include "tools/learning/training.h"

#include <doctest/doctest.h>

#include <numeric>

using namespace pluvia;

namespace {

/// Streaks lighten the picture by half of what is missing to white.
TrainingPair pair_by_formula() {
    TrainingPair p{Image<Rgba8>(64, 64), {}, Image<uint8_t>(64, 64), {}};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            p.background.at(x, y) = {uint8_t(40 + 2 * x), uint8_t(60 + y), 90, 255};
            p.coverage.at(x, y) = uint8_t((2 * x + y) % 11 < 4 ? 128 : 0);
        }
    p.layer = Image<Rgba8>(64, 64);
    std::fill(p.layer.pixels.begin(), p.layer.pixels.end(), Rgba8{255, 255, 255, 128});
    p.rainy = p.background;
    for (size_t i = 0; i < p.rainy.pixels.size(); ++i)
        if (p.coverage.pixels[i] > 0) {
            Rgba8& c = p.rainy.pixels[i];
            c = {uint8_t((c.r + 255) / 2), uint8_t((c.g + 255) / 2), uint8_t((c.b + 255) / 2), 255};
        }
    return p;
}

TrainingSettings quick() {
    TrainingSettings s;
    s.multipliers = {1, 2};
    s.batch = 4;
    s.crop = 32;
    s.steps = 120;
    s.learning_rate = 5e-3;
    return s;
}

}  // namespace

TEST_CASE("training on one pair learns it") {
    const TemporaryFolder folder;
    set_learning_threads(1);
    Trainer trainer({pair_by_formula()}, quick());
    for (int i = 0; i < 120; ++i) trainer.train_step();
    const std::vector<double> losses = trainer.take_losses();
    REQUIRE(losses.size() == 120);
    CHECK(losses.back() < 0.05 * losses.front());
    CHECK(trainer.take_losses().empty());
    trainer.save_model(folder / "model", "one pair");
    const auto model = load_model(folder / "model");
    CHECK(config_of(*model).metadata.at("training") == "one pair");
    const TrainingPair p = pair_by_formula();
    SynthesisSettings s;
    s.blend.soft = false;
    const Image<Rgba8> result = synthesize(*model, p.background, p.coverage, s);
    double clean = 0, learnt = 0;
    for (size_t i = 0; i < result.pixels.size(); ++i) {
        clean += std::pow(p.background.pixels[i].g - p.rainy.pixels[i].g, 2);
        learnt += std::pow(result.pixels[i].g - p.rainy.pixels[i].g, 2);
    }
    CHECK(learnt < 0.1 * clean);

    Trainer further({pair_by_formula()}, quick());
    further.start_from(folder / "model");
    further.train_step();
    CHECK(further.take_losses().front() < 0.1 * losses.front());
    TrainingSettings wider = quick();
    wider.channels = 24;
    Trainer other({pair_by_formula()}, wider);
    CHECK_THROWS_AS(other.start_from(folder / "model"), Error);
}

TEST_CASE("training that was interrupted ends with the same weights as one that was not") {
    const TemporaryFolder folder;
    set_learning_threads(1);
    for (const auto kind : {ModelConfig::Kind::regression, ModelConfig::Kind::diffusion}) {
        CAPTURE(model_kind_name(kind));
        TrainingSettings s = quick();
        s.kind = kind;
        s.steps = 6;
        Trainer whole({pair_by_formula()}, s);
        for (int i = 0; i < 6; ++i) whole.train_step();
        whole.save(folder / "whole");
        {
            Trainer first({pair_by_formula()}, s);
            for (int i = 0; i < 3; ++i) first.train_step();
            first.save(folder / "half");
        }
        Trainer second({pair_by_formula()}, s);
        second.load(folder / "half");
        REQUIRE(second.step() == 3);
        for (int i = 0; i < 3; ++i) second.train_step();
        second.save(folder / "resumed");
        CHECK(read_file(folder / "whole") == read_file(folder / "resumed"));
        s.batch = 2;
        Trainer other({pair_by_formula()}, s);
        CHECK_THROWS_AS(other.load(folder / "half"), Error);
    }
}

TEST_CASE("pictures that are too small or differ in size are refused") {
    TrainingPair p = pair_by_formula();
    p.rainy = Image<Rgba8>(63, 64);
    CHECK_THROWS_AS(Trainer({p}, quick()), Error);
    TrainingSettings s = quick();
    s.crop = 128;
    CHECK_THROWS_AS(Trainer({pair_by_formula()}, s), Error);
}

TEST_CASE("a diffusion model and its guide learn one pair, and draw it from noise") {
    const TemporaryFolder folder;
    set_learning_threads(1);
    TrainingSettings s = quick();
    s.kind = ModelConfig::Kind::diffusion;
    s.channels = 32;
    s.steps = 200;
    Trainer trainer({pair_by_formula()}, s);
    for (int i = 0; i < s.steps; ++i) trainer.train_step();
    const std::vector<double> losses = trainer.take_losses();
    const auto mean = [&](size_t from) { return std::accumulate(&losses[from], &losses[from] + 20, 0.0) / 20; };
    CAPTURE(mean(0));
    CAPTURE(mean(180));
    CHECK(mean(180) < 0.4 * mean(0));
    trainer.save_model(folder / "model", "one pair");
    const auto model = load_model(folder / "model");
    CHECK(config_of(*model).guide.has_value());
    CHECK(config_of(*model).fold == 4);
    const TrainingPair p = pair_by_formula();
    SynthesisSettings how;
    const Image<Rgba8> result = synthesize(*model, p.background, p.coverage, how);
    // So short a training draws rough streaks, but of the right brightness.
    double truth = 0, drawn = 0;
    for (size_t i = 0; i < result.pixels.size(); ++i) {
        truth += p.rainy.pixels[i].g - p.background.pixels[i].g;
        drawn += result.pixels[i].g - p.background.pixels[i].g;
    }
    CHECK(drawn / truth == doctest::Approx(1).epsilon(0.3));
    how.seed = 1;
    CHECK_FALSE(synthesize(*model, p.background, p.coverage, how).pixels == result.pixels);
}
