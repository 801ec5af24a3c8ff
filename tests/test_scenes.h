// What the tests of light transport are made of: the scenes and pictures that `pluvia validate closed-forms` has too.
#pragma once

#include "tools/validate/known_scenes.h"
#include "tools/validate/rendered_picture.h"
