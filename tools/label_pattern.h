// The regular expressions of label rules, compiled so that no expression and no name of a node hangs or crashes.
#pragma once

#include <regex>
#include <string>

namespace pluvia {

/// Characters of the expression with its repetitions written out, at least those it has: "a{2,30}" is 36. Bounds what
/// one character of a node's path can cost. Saturates at 2^30.
size_t written_out_length(const std::string& pattern);

/// An ECMAScript expression without references back to groups and without looking ahead. To match it takes time
/// proportional to the length of what is matched, below a millisecond a character. where: "FILE:LINE" of errors.
/// Throws Error, usage: it is no expression, refers back, looks ahead, or is above 1000 characters written out.
std::regex compile_label_pattern(const std::string& pattern, const std::string& where);

}  // namespace pluvia
