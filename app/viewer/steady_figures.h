// SPDX-License-Identifier: MIT
// What a picture would say of its own making on a machine that takes exactly a tenth of a second for a sample of every
// pixel: so that replays are the same everywhere.
#pragma once

#include "renderer/session/render_session.h"

namespace candela {

void make_steady(SessionStatus& status);
ErrorHistory steady(const ErrorHistory& history);

}  // namespace candela
