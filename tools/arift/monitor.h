// A connection to the running service in the role of a monitor.
#pragma once
#include "runtime/ipc/request.h"
#include <nlohmann/json_fwd.hpp>

namespace arift::tools
{

class Monitor
{
public:
	/// Throws std::runtime_error where no service runs; starts none.
	Monitor();

	/// The reply, or std::runtime_error with what the service said.
	template <typename Reply, typename Request> ipc::Answer<Reply> ask(const Request &request)
	{
		auto answer = requests_.ask<Reply>(request, limit);
		if (!answer) throw std::runtime_error(ipc::textOf(answer.failure.text));
		return answer;
	}

private:
	static constexpr XrDuration limit = 75 * second; // opening devices and a picture of a slow renderer included
	ipc::Requests requests_;
};

/// What the service says of itself.
nlohmann::json statusOf(Monitor &monitor, bool resetFigures = false);

} // namespace arift::tools
