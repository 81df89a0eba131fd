// Settings that programs change, kept for the next start: overrides.toml beside the user's own configuration, which is never rewritten.
#pragma once
#include <filesystem>
#include <mutex>
#include <string>
#include <variant>
#include <vector>

namespace arift
{

/// Of the user: overrides.toml in the configuration directory.
std::filesystem::path overridesFile();

/// Thread-safe.
class Overrides
{
public:
	/// `file` instead of the user's. Nothing is read: what it says is part of the configuration. It is made with the first setting.
	explicit Overrides(std::filesystem::path file = {}) : file_(std::move(file)) {}

	using Value = std::variant<float, std::string>;
	using Values = std::vector<std::pair<std::string, Value>>;
	/// Keeps values in `table`, a path of keys, and every other setting of the file. The file is replaced as a whole or not at all. Throws
	/// InputError that names the file where it cannot be written, or holds something else than settings.
	void keep(const std::vector<std::string> &table, const Values &values);

private:
	const std::filesystem::path file_;
	std::mutex writing_; ///< one at a time
};

} // namespace arift
