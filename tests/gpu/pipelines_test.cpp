// The renderer's pipelines: those that applications can ask for are not as many as they can think of.
#include "runtime/compositor/pipelines.h"
#include "tests/gpu/panel_fixture.h"

namespace arift
{
namespace
{

/// Tests of depth in every comparison, written and not, on surfaces whose blend factors differ.
std::vector<PipelineKey> manyKeys(size_t count)
{
	std::vector<PipelineKey> keys;
	for (const ByAlphaBelow source : {ByAlphaBelow::no, ByAlphaBelow::alpha, ByAlphaBelow::rest})
		for (const ByAlphaBelow kept : {ByAlphaBelow::no, ByAlphaBelow::alpha, ByAlphaBelow::rest})
			for (const ByAlphaBelow alpha : {ByAlphaBelow::no, ByAlphaBelow::alpha, ByAlphaBelow::rest})
				for (int compare = VK_COMPARE_OP_NEVER; compare <= VK_COMPARE_OP_ALWAYS; ++compare)
					for (const bool writes : {false, true})
						keys.push_back({.blend = Blend::over,
										.layer = Cover::partly,
										.surface = Surface::flat,
										.depth = Depth::tested,
										.compare = VkCompareOp(compare),
										.writesDepth = writes,
										.byAlphaBelow = {source, kept, alpha}});
	keys.resize(count);
	return keys;
}

TEST(Pipelines, SoManyUnusualOnesAreMadeAndNoMore)
{
	gpu::Device device;
	{
		const PanelOptics optics(plainRig());
		Pipelines pipelines(device.handles(), vk::Format::eR8G8B8A8Srgb, optics);
		const std::vector<PipelineKey> keys = manyKeys(Pipelines::mostOthers + 2);
		for (const PipelineKey &key : keys) EXPECT_FALSE(pipelines.find(key)) << "none can be there at once";
		const auto isMade = [&](size_t i) {
			for (const XrTime end = realTime() + 100 * second; realTime() < end; std::this_thread::yield())
				if (pipelines.find(keys[i])) return true;
			return false;
		};
		EXPECT_TRUE(isMade(Pipelines::mostOthers - 1)) << "they are made in their order";
		for (const size_t beyond : {Pipelines::mostOthers, Pipelines::mostOthers + 1}) EXPECT_FALSE(pipelines.find(keys[beyond]));
		EXPECT_TRUE(pipelines.at(keys.back())) << "what is waited for is not counted";
	}
	EXPECT_EQ(device.validationMessages(), 0u);
}

} // namespace
} // namespace arift
