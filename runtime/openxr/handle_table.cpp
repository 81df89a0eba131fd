#include "runtime/openxr/handle_table.h"

namespace arift::openxr
{

static_assert(std::is_trivially_destructible_v<HandleTable>, "nothing of this library runs when the application's process exits");
constinit HandleTable handles;

namespace
{
uint32_t indexOf(uint64_t handle) { return uint32_t(handle); }
} // namespace

uint64_t HandleTable::put(Object *object, XrObjectType type, const Object *parent)
{
	std::lock_guard lock(mutex_);
	uint32_t index = firstFree_;
	if (index != slotCount)
		firstFree_ = slots_[index].nextFree;
	else if (used_ < slotCount)
		index = used_++;
	else
		throw Error(XR_ERROR_LIMIT_REACHED, "{} handles are alive already", slotCount);
	Slot &slot = slots_[index];
	slot.object = object;
	slot.type = type;
	slot.parent = parent ? indexOf(parent->handle_) : slotCount;
	object->handle_ = uint64_t(++slot.generation) << 32 | index;
	slot.handle.store(object->handle_, std::memory_order_release);
	++alive_;
	return object->handle_;
}

void HandleTable::refuse(uint64_t handle, XrObjectType wanted) const
{
	if (handle == 0) throw Error(XR_ERROR_HANDLE_INVALID, "the handle is XR_NULL_HANDLE");
	const uint32_t index = indexOf(handle);
	if (index >= slotCount || slots_[index].handle.load(std::memory_order_acquire) != handle)
		throw Error(XR_ERROR_HANDLE_INVALID, "{:#x} is no handle, or was destroyed", handle);
	throw Error(XR_ERROR_HANDLE_INVALID, "{:#x} is a handle of XrObjectType {}, not {}", handle, int(slots_[index].type), int(wanted));
}

XrObjectType HandleTable::typeOf(uint64_t handle) const
{
	const uint32_t index = indexOf(handle);
	const bool valid = handle != 0 && index < slotCount && slots_[index].handle.load(std::memory_order_acquire) == handle;
	return valid ? slots_[index].type : XR_OBJECT_TYPE_UNKNOWN;
}

Object *HandleTable::find(uint64_t handle, XrObjectType type) const
{
	const XrObjectType found = typeOf(handle);
	return found != XR_OBJECT_TYPE_UNKNOWN && (type == found || type == XR_OBJECT_TYPE_UNKNOWN) ? slots_[indexOf(handle)].object : nullptr;
}

Object *HandleTable::findRoot(uint64_t handle, XrObjectType type) const
{
	uint32_t index = indexOf(handle);
	if (handle == 0 || index >= slotCount || slots_[index].handle.load(std::memory_order_acquire) != handle) return nullptr;
	while (slots_[index].parent != slotCount) index = slots_[index].parent;
	return slots_[index].type == type ? slots_[index].object : nullptr;
}

std::vector<Object *> HandleTable::takeOut(const Object &object)
{
	std::lock_guard lock(mutex_);
	std::vector<uint32_t> family{indexOf(object.handle_)};
	for (size_t i = 0; i < family.size(); ++i)
		for (uint32_t index = 0; index < used_; ++index)
			if (slots_[index].handle.load(std::memory_order_relaxed) && slots_[index].parent == family[i]) family.push_back(index);
	std::vector<Object *> objects;
	for (const uint32_t index : family) {
		Slot &slot = slots_[index];
		objects.push_back(std::exchange(slot.object, nullptr));
		slot.handle.store(0, std::memory_order_release);
		slot.nextFree = std::exchange(firstFree_, index);
		--alive_;
	}
	return objects;
}

void HandleTable::destroy(const Object &object)
{
	std::vector<Object *> objects = takeOut(object);
	for (auto youngest = objects.rbegin(); youngest != objects.rend(); ++youngest) delete *youngest;
}

void HandleTable::forget(const Object &object) { takeOut(object); }

uint32_t HandleTable::size() const
{
	std::lock_guard lock(mutex_);
	return alive_;
}

} // namespace arift::openxr
