// All around the library: a service that grants, tells and fails as a program says, and a GPU that is none.
#pragma once
#include "tests/fuzz/entry_points/making.h"
#include "tests/openxr/fake_graphics.h"

namespace arift::fuzz
{

/// Of the process; after each program it is as before.
class World
{
public:
	World();

	// ---- what a program can have happen
	/// A session with graphics for the newest instance, as xrCreateSession makes one.
	void makeSession(State &state);
	/// The service has an event for whichever session there is.
	void tell(Choices choices);
	/// What is in a person's hands.
	void play(Choices choices);
	/// What fails from now on, and which clock the service has.
	void fail(Choices choices);
	void hangUp();

	/// Whether something was told to fail: only then may the library say that it failed.
	bool mayFail() const { return mayFail_; }
	/// The service has this frame of a session's: what an image waits for does not depend on how fast the machine is.
	void settle(const openxr::Session &session, uint64_t frame);
	/// All instances are destroyed by now: nothing of them is left.
	void end();

private:
	void writePages();
	void check(const ipc::Received &message, bool isFrame);
	openxr::FakeDevice device_;
	FakeService service_;
	bool mayFail_ = false, isGone_ = false;
	size_t threads_ = 0, descriptors_ = 0; ///< after the first program
};

} // namespace arift::fuzz
