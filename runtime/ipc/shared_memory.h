// Shared pages: a sealed memfd, mapped read-write by its maker and read-only by everybody else.
#pragma once
#include "runtime/base/unique_fd.h"
#include <cstddef>
#include <new>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

namespace arift::ipc
{

/// Owns a mapping of `size` bytes.
class Mapping
{
public:
	Mapping() = default;
	Mapping(void *address, size_t size) : address_(address), size_(size) {}
	Mapping(Mapping &&other) noexcept : address_(std::exchange(other.address_, nullptr)), size_(std::exchange(other.size_, 0)) {}
	Mapping &operator=(Mapping &&other) noexcept
	{
		std::swap(address_, other.address_);
		std::swap(size_, other.size_);
		return *this;
	}
	~Mapping();
	void *address() const { return address_; }
	size_t size() const { return size_; }

private:
	void *address_ = nullptr;
	size_t size_ = 0;
};

/// A memfd of `size` zero bytes that can neither grow nor shrink. Throws std::system_error.
UniqueFd makeSharedMemory(const char *name, size_t size);
/// No further mapping may write (F_SEAL_FUTURE_WRITE); mappings that exist may. To be called before the descriptor leaves the process.
void sealAgainstWriting(int fd);
Mapping mapWritable(int fd, size_t size);
/// Maps for reading a page that another process made. Throws std::runtime_error where the memory is not at least `size` bytes or could
/// still shrink under the reader.
Mapping mapReadOnly(int fd, size_t size);

/// A read-only copy of `bytes` for another process: sealed against everything.
UniqueFd makeSealedCopy(const char *name, std::span<const std::byte> bytes);

/// A T in shared memory, made by this process: constructed in place, writable here, read-only for whoever is given the descriptor.
template <typename T> class SharedPage
{
	static_assert(std::is_trivially_destructible_v<T> && std::is_standard_layout_v<T>);

public:
	explicit SharedPage(const char *name) : fd_(makeSharedMemory(name, sizeof(T))), mapping_(mapWritable(fd_.get(), sizeof(T)))
	{
		page_ = new (mapping_.address()) T{};
		sealAgainstWriting(fd_.get());
	}
	T &operator*() const { return *page_; }
	T *operator->() const { return page_; }
	int fd() const { return fd_.get(); }

private:
	UniqueFd fd_;
	Mapping mapping_;
	T *page_;
};

/// A T that another process wrote or is writing. Nothing in it is to be trusted.
template <typename T> class SharedPageView
{
public:
	explicit SharedPageView(UniqueFd fd) : mapping_(mapReadOnly(fd.get(), sizeof(T))) {}
	const T &operator*() const { return *static_cast<const T *>(mapping_.address()); }
	const T *operator->() const { return static_cast<const T *>(mapping_.address()); }

private:
	Mapping mapping_;
};

} // namespace arift::ipc
