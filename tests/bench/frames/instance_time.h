// An application as far as its first call.
#pragma once

/// Milliseconds that xrCreateInstance takes, loading the runtime included, in this process' environment. Throws std::runtime_error.
double instanceMilliseconds();
