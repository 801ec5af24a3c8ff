// Regular expressions of label rules: what they match is what ECMAScript says, and neither they nor names hang a
// render.
#include "tools/label_pattern.h"
#include "tests/error_of.h"

#include <doctest/doctest.h>

namespace pluvia {
namespace {

std::regex compiled(const std::string& pattern) {
    return compile_label_pattern(pattern, "rules.yaml:1");
}
std::string refusal(const std::string& pattern) {
    return error_of([&] { compiled(pattern); }).what();
}

/// All words of the letters a, b and / up to a length.
std::vector<std::string> words(size_t longest) {
    std::vector<std::string> result = {""};
    for (size_t i = 0; i < result.size() && result[i].size() < longest; ++i)
        for (const char c : {'a', 'b', '/'}) result.push_back(result[i] + c);
    return result;
}

}  // namespace

TEST_CASE("a pattern matches what the library's usual matcher does, with the same groups") {
    for (const char* pattern : {".*", "(a|ab)(.*)", "(a*)(a|b)+(/.*)?", "(.*)/(.*)", "(.*?)/(.*?)", "a{1,3}?(.*)b",
                                "(?:a|/)+(b?)", "[^/]*(/[^/]*)", "(ab|a)(/|b/)(a{2}|)", "\\ba\\b.*"}) {
        INFO(pattern);
        const std::regex usual(pattern), ours = compiled(pattern);
        int matched = 0;
        for (const std::string& word : words(6)) {
            std::smatch expected, found;
            const bool matches = std::regex_match(word, expected, usual);
            REQUIRE_MESSAGE(std::regex_match(word, found, ours) == matches, word);
            for (size_t i = 0; matches && i < expected.size(); ++i) REQUIRE_MESSAGE(found[i] == expected[i], word);
            matched += matches;
        }
        CHECK(matched > 0);
        CHECK(matched <= 1093);
    }
}

TEST_CASE("no name is too long to be matched and no pattern tries every way to match one") {
    std::smatch match;
    const std::string far = std::string(300000, 'a') + "/leaf";
    REQUIRE(std::regex_match(far, match, compiled("(.*)/leaf")));
    CHECK(match[1].length() == 300000);
    const std::string near_miss = std::string(60, 'a') + "!";
    for (const char* pattern : {"(a*)*b", "(a|a)*b", "(a|aa)+b", "(.*a){12}b"})
        CHECK_FALSE(std::regex_match(near_miss, compiled(pattern)));
}

TEST_CASE("a pattern costs at most what its repetitions written out cost") {
    CHECK(written_out_length("tree_[0-9]+") == 11);
    CHECK(written_out_length("a{2,30}") == 36);
    CHECK(written_out_length("(ab){10}") == 4 * 10 + 4);
    CHECK(written_out_length("((a{9}){9}){9}") > 729);
    CHECK(written_out_length("(a[)]b){50}") == 7 * 50 + 4);
    CHECK(written_out_length("(a[[:alpha:])]b){50}") == 16 * 50 + 4);
    CHECK(written_out_length("(a\\)b){50}") == 6 * 50 + 4);
    CHECK(written_out_length("a{99999999999999999999}{99999999999999999999}") == size_t(1) << 30);
    for (const char* pattern : {"a{1111111111}", "a{1,1111111111}", "((a?){40}){40}", "(a{1111111111"})
        CHECK(refusal(pattern).find("rules.yaml:1: nodes is too long (got ") == 0);
    CHECK(refusal(std::string(1001, 'a')).find("got 1001 characters") != std::string::npos);
    CHECK_NOTHROW(compiled(std::string(1000, 'a')));
    CHECK_NOTHROW(compiled("car_20261126120000"));
}

TEST_CASE("a pattern that refers back, looks ahead or is none is refused") {
    CHECK(refusal("(a)\\1").find("refers back to a group") != std::string::npos);
    CHECK(refusal("(a)\\1111111111").find("refers back to a group") != std::string::npos);
    for (const char* pattern : {"(?!tree).*", "((?=.*)a)*"})
        CHECK(refusal(pattern).find("looks ahead (got \"(?") != std::string::npos);
    CHECK_NOTHROW(compiled("a\\\\1(?:b)\\(?=c"));
    for (const char* pattern : {"(a", "a)", "[a", "*a", "a{", "\\", "[[.a{999}]a{999}"})
        CHECK(refusal(pattern).find("is no regular expression (got \"") != std::string::npos);
}

}  // namespace pluvia
