// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Declarations of that part of YADE's binary interface which a plugin needs. Packages of YADE have no headers.
#include "yade_api/body.hpp"
#include "yade_api/engine.hpp"
#include "yade_api/scene.hpp"
#include "yade_api/serializable.hpp"
#include "yade_api/types.hpp"
