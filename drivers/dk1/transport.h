// How bytes reach a DK1 tracker: the USB device behind hidraw, or a model of it.
#pragma once
#include "runtime/base/clock.h"
#include "runtime/device/outcome.h"
#include <cstddef>
#include <span>
#include <string>

namespace arift::dk1
{

class Transport
{
public:
	virtual ~Transport() = default;
	/// For people: which device this is.
	virtual std::string name() const = 0;
	/// Blocks until an input report is there, `deadline` has come or stop is requested (both: timeout). A report longer than `buffer` is
	/// cut.
	virtual Outcome read(std::span<std::byte> buffer, size_t &length, XrTime &arrival, XrTime deadline, std::stop_token stop) = 0;
	/// Starts to set a feature report and returns at once, however long the device takes: reading never waits for it.
	virtual void post(std::span<const std::byte> feature) = 0;
};

} // namespace arift::dk1
