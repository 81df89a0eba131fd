// What a driver is told of its configuration.
#pragma once
#include "runtime/base/toml_document.h"

namespace arift::test
{

inline std::shared_ptr<const TomlDocument> documentOf(const std::filesystem::path &file) { return std::make_shared<TomlDocument>(file); }

} // namespace arift::test
