// Who owns every object behind an OpenXR handle, and which handles are valid.
// A handle is generation and index of a slot: null, stale and foreign handles are told apart without touching freed memory. Looking one up
// takes no lock. Destroying a handle destroys its children first, as the specification's "Object Handle Types" asks.
#pragma once
#include "runtime/base/guarded.h"
#include "runtime/openxr/error.h"
#include <array>
#include <atomic>
#include <concepts>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace arift::openxr
{

/// What every handle stands for.
class Object
{
public:
	Object() = default;
	Object(const Object &) = delete;
	virtual ~Object() = default;
	/// Throws XR_ERROR_INSTANCE_LOST or XR_ERROR_SESSION_LOST where nothing can be done with the object any more but destroying it.
	virtual void requireAlive() const = 0;
	uint64_t handleValue() const { return handle_; }

	/// What the application calls it in messages (xrSetDebugUtilsObjectNameEXT); empty: nothing.
	Guarded<std::string> debugName;

private:
	friend class HandleTable;
	uint64_t handle_ = 0;
};

/// T's handle type and XrObjectType: HandleOf<Session>::type is XrSession.
template <typename T> struct HandleOf;
template <typename T>
concept HandleObject = std::derived_from<std::remove_const_t<T>, Object>;

template <HandleObject T> typename HandleOf<std::remove_const_t<T>>::type handleOf(const T &object)
{
	return reinterpret_cast<typename HandleOf<std::remove_const_t<T>>::type>(object.handleValue());
}

class HandleTable
{
public:
	static constexpr uint32_t slotCount = 1u << 16;

	/// Takes ownership. `parent` (null for an instance) must be in the table. Throws XR_ERROR_LIMIT_REACHED.
	template <HandleObject T> typename HandleOf<T>::type insert(std::unique_ptr<T> object, const Object *parent)
	{
		const uint64_t handle = put(object.get(), HandleOf<T>::objectType, parent);
		static_cast<void>(object.release());                         // the table's now
		return reinterpret_cast<typename HandleOf<T>::type>(handle); // NOLINT(performance-no-int-to-ptr): OpenXR's handles are pointers
	}

	template <HandleObject T> T &at(typename HandleOf<std::remove_const_t<T>>::type handle) const
	{
		constexpr XrObjectType type = HandleOf<std::remove_const_t<T>>::objectType;
		const auto value = reinterpret_cast<uint64_t>(handle);
		const Slot &slot = slots_[uint32_t(value) % slotCount];
		if (slot.handle.load(std::memory_order_acquire) != value || value == 0 || slot.type != type) refuse(value, type);
		return static_cast<T &>(*slot.object);
	}

	/// What `handle` and all its ancestors lie below; null for what is no handle now, and where it is no T.
	template <HandleObject T> T *rootOf(uint64_t handle) const { return static_cast<T *>(findRoot(handle, HandleOf<T>::objectType)); }

	/// The object of a handle; null where it is none, or not of that type. XR_OBJECT_TYPE_UNKNOWN: of any.
	Object *find(uint64_t handle, XrObjectType type) const;
	/// XR_OBJECT_TYPE_UNKNOWN for what is no handle now.
	XrObjectType typeOf(uint64_t handle) const;
	/// Destroys the object and all below it, youngest generation first.
	void destroy(const Object &object);
	/// As destroy, but the objects are only forgotten: in a forked child their threads do not exist and their sockets are the parent's.
	void forget(const Object &object);
	/// Objects alive.
	uint32_t size() const;

private:
	struct Slot {
		std::atomic<uint64_t> handle{0}; ///< 0 while free
		Object *object = nullptr;
		XrObjectType type = XR_OBJECT_TYPE_UNKNOWN;
		uint32_t generation = 0;
		uint32_t parent = slotCount; ///< slotCount: none
		uint32_t nextFree = slotCount;
	};

	uint64_t put(Object *object, XrObjectType type, const Object *parent);
	/// Throws XR_ERROR_HANDLE_INVALID with the reason.
	[[noreturn]] void refuse(uint64_t handle, XrObjectType wanted) const;
	Object *findRoot(uint64_t handle, XrObjectType type) const;
	std::vector<Object *> takeOut(const Object &object);

	mutable std::mutex mutex_;
	uint32_t used_ = 0;
	uint32_t alive_ = 0;
	uint32_t firstFree_ = slotCount;
	std::array<Slot, slotCount> slots_{};
};

/// Lies in zeroed memory and has no destructor that runs at exit.
extern HandleTable handles;

} // namespace arift::openxr
