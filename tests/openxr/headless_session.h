// An application with a session that has no graphics, on a fake service: what most functions need to be tried.
#pragma once
#include "tests/openxr/application.h"
#include "tests/openxr/fake_service.h"

namespace arift
{

struct HeadlessApplication {
	explicit HeadlessApplication(std::vector<const char *> extensions = {}, XrVersion version = XR_API_VERSION_1_1)
		: application(withHeadless(std::move(extensions)), version)
	{
		EXPECT_EQ(application.created, XR_SUCCESS);
	}
	template <typename Pfn> Pfn get(const char *name) const
	{
		const auto function = application.get<Pfn>(name);
		if (!function) throw std::runtime_error(std::string(name) + " is not there");
		return function;
	}

	FakeService service;
	Application application;
	XrSession session = application.session();

private:
	static std::vector<const char *> withHeadless(std::vector<const char *> extensions)
	{
		extensions.push_back("XR_MND_headless");
		return extensions;
	}
};

} // namespace arift
