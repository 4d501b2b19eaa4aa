#pragma once

/// For programs outside: the header stays here whatever chapter it belongs to.

#include "core/scene/solution.hpp"
