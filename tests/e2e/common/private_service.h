// An arift-service of a test's own, and a connection that asks it for its status, for pictures and for changes of settings.
#pragma once
#include "runtime/ipc/request.h"
#include "tests/e2e/common/child_process.h"
#include "tests/e2e/common/private_tree.h"
#include <array>
#include <functional>
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

/// A connection to the service that listens in `tree`; nothing where none does.
std::optional<ipc::Socket> connectTo(const PrivateTree &tree);

/// Thread-bound. Every request is answered within a limit or throws std::runtime_error with what the service said and printed.
class PrivateService
{
public:
	/// Starts the service with `configuration` (TOML text) and waits until it answers. `program`: of this build tree.
	explicit PrivateService(const std::string &configuration, std::vector<std::string> arguments = {},
							const std::string &program = "arift-service");
	~PrivateService();
	PrivateService(PrivateService &&) noexcept;

	const PrivateTree &tree() const { return *tree_; }
	ChildProcess &process() { return service_; }
	/// Starts an application of this build tree that finds this service.
	ChildProcess start(const std::string &program, std::vector<std::string> arguments) const;

	nlohmann::json status(bool resetFigures = false);
	PanelPicture screenshot(ipc::PictureKind kind = ipc::PictureKind::panel);
	void set(ipc::Setting setting, float value);
	void recenter();

private:
	[[noreturn]] void fail(const std::string &what, const ipc::Failed &failure);

	std::unique_ptr<PrivateTree> tree_;
	ChildProcess service_;
	std::unique_ptr<ipc::Requests> connection_;
};

/// Asks for the status until it is as `wanted`; false where it is not within `limit` of real time: a busy machine takes long to open a
/// headset.
bool eventually(PrivateService &service, const std::function<bool(const nlohmann::json &)> &wanted, XrDuration limit = 75 * second);

/// Of the green channel in the middle half of a picture's rows, columns `left` to `right`.
struct Statistics {
	double mean = 0, deviation = 0, lit = 0; ///< lit: share of pixels that are not black
};
Statistics statisticsOf(const PanelPicture &picture, uint32_t left, uint32_t right);
/// The middle of each eye's half of the panel, left and right.
std::array<Statistics, 2> statisticsOfEyes(const PanelPicture &panel);

} // namespace arift::e2e
