// An arift-service of a test's own, and a connection that asks it for its status, for pictures and for changes of settings.
#pragma once
#include "runtime/ipc/request.h"
#include "tests/e2e/common/child_process.h"
#include "tests/e2e/common/private_tree.h"
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace arift::e2e
{

/// The panel as it was shown.
struct PanelPicture {
	uint32_t width = 0, height = 0;
	XrTime displayTime = 0;    ///< of the middle line
	std::vector<uint8_t> rgba; ///< sRGB encoded rows
};

/// Thread-bound. Every request is answered within a limit or throws std::runtime_error with what the service said and printed.
class PrivateService
{
public:
	/// Starts the service with `configuration` (TOML text) and waits until it answers.
	explicit PrivateService(const std::string &configuration, std::vector<std::string> arguments = {});
	~PrivateService();
	PrivateService(PrivateService &&) noexcept;

	const PrivateTree &tree() const { return *tree_; }
	ChildProcess &process() { return service_; }
	/// Starts an application of this build tree that finds this service.
	ChildProcess start(const std::string &program, std::vector<std::string> arguments) const;

	nlohmann::json status(bool resetFigures = false);
	PanelPicture screenshot(ipc::PictureKind kind = ipc::PictureKind::panel);
	void set(ipc::Setting setting, float value);

private:
	[[noreturn]] void fail(const std::string &what, const ipc::Failed &failure);

	std::unique_ptr<PrivateTree> tree_;
	ChildProcess service_;
	std::unique_ptr<ipc::Requests> connection_;
};

} // namespace arift::e2e
