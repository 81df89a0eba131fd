// What validation layers had to say about a program, without what is expected of programs and layers that are not ours.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace arift::e2e
{

/// Ids that are expected, from a file of lines "ID reason"; '#' begins a comment. Throws std::runtime_error where an id has no reason.
std::vector<std::string> expectedMessages(const std::filesystem::path &file);

/// One entry "ID: line" for each error or warning in `text` that is not expected: of the Vulkan validation layer ("Validation Error: [ ID ]
/// ..."), of the OpenXR core validation layer ("[...][VALID_ERROR | ID | function] : ...") and of the OpenXR loader ("Error [...").
std::vector<std::string> unexpectedMessages(const std::string &text, const std::vector<std::string> &expected);

} // namespace arift::e2e
