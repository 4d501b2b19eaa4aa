#pragma once

/// For programs outside: the header stays here whatever chapter it belongs to.

#include "core/solve/rolling_contact.hpp"
