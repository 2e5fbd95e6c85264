#include "hand_model.h"
