#include "tools/label_pattern.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace pluvia {
namespace {

constexpr size_t longest = 1000;
constexpr size_t endless = size_t(1) << 30;

/// The place after the bracket expression that begins at i, "[a-z\\]]" or "[[:alpha:]_]".
size_t end_of_brackets(const std::string& pattern, size_t i) {
    for (++i; i < pattern.size() && pattern[i] != ']'; ++i) {
        if (pattern[i] == '\\') {
            ++i;
        } else if (pattern[i] == '[' && i + 1 < pattern.size() &&
                   std::string(":.=").find(pattern[i + 1]) != std::string::npos) {
            const size_t end = pattern.find({pattern[i + 1], ']'}, i + 2);
            if (end == std::string::npos) return pattern.size();
            i = end + 1;
        }
    }
    return std::min(i + 1, pattern.size());
}

/// The greatest number in the braces that begin at i, at least 1, and the place after them.
size_t greatest_count(const std::string& pattern, size_t& i) {
    size_t greatest = 1, number = 0;
    for (++i; i < pattern.size() && pattern[i] != '}'; ++i) {
        const char c = pattern[i];
        number = c >= '0' && c <= '9' ? std::min(number * 10 + size_t(c - '0'), endless) : 0;
        greatest = std::max(greatest, number);
    }
    i = std::min(i + 1, pattern.size());
    return greatest;
}

/// A group that is open: what came before its last part, and that part, to which a repetition applies.
struct Group {
    size_t before = 0, last = 0;
    void add(size_t length) {
        before += last;
        last = length;
    }
    size_t length() const { return before + last; }
};

/// What costs more than a look at each character: "\1", "(?=" or "(?!"; empty without.
std::string costly_part(const std::string& pattern) {
    for (size_t i = 0; i + 1 < pattern.size(); ++i) {
        const bool escapes = pattern[i] == '\\';
        if (escapes && pattern[i + 1] >= '1' && pattern[i + 1] <= '9') return pattern.substr(i, 2);
        if (pattern.compare(i, 3, "(?=") == 0 || pattern.compare(i, 3, "(?!") == 0) return pattern.substr(i, 3);
        i += escapes;
    }
    return "";
}

}  // namespace

size_t written_out_length(const std::string& pattern) {
    std::vector<Group> open(1);
    for (size_t i = 0; i < pattern.size();) {
        const size_t begin = i++;
        const char c = pattern[begin];
        if (c == '(') {
            open.emplace_back();
        } else if (c == ')' && open.size() > 1) {
            const size_t inside = open.back().length() + 2;
            open.pop_back();
            open.back().add(inside);
        } else if (c == '{') {
            i = begin;
            const size_t count = greatest_count(pattern, i);
            size_t& last = open.back().last;
            last = std::min(last * count + (i - begin), endless);
        } else if (c == '*' || c == '+' || c == '?') {
            ++open.back().last;
        } else {
            if (c == '[') i = end_of_brackets(pattern, begin);
            if (c == '\\') i = std::min(i + 1, pattern.size());
            open.back().add(i - begin);
        }
    }
    size_t length = open.size() - 1;  // parentheses that nothing closes
    for (const Group& group : open) length += group.length();
    return std::min(length, endless);
}

std::regex compile_label_pattern(const std::string& pattern, const std::string& where) {
    // Before the parser sees it, which calls itself for each part of an expression and overflows on great numbers.
    const size_t length = written_out_length(pattern);
    if (length > longest)
        throw usage_error(where, fmt::format("nodes is too long (got {} characters with repetitions written out, "
                                             "expected at most {})",
                                             length, longest));
    const std::string costly = costly_part(pattern);
    if (!costly.empty())
        throw usage_error(where, fmt::format("nodes refers back to a group or looks ahead (got \"{}\" in \"{}\", "
                                             "expected neither)",
                                             costly, pattern));
    try {
        // The library's usual matcher calls itself for each character of a path, until the stack is used up, and tries
        // each way to match "(a*)*". This flag of libstdc++ has all ways followed at once; it forbids to refer back.
        return std::regex(pattern, std::regex::ECMAScript | std::regex_constants::__polynomial);
    } catch (const std::regex_error& e) {
        throw usage_error(where, fmt::format("nodes is no regular expression (got \"{}\": {})", pattern, e.what()));
    }
}

}  // namespace pluvia
