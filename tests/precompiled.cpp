// This file has no code, because the precompiled header of the tests needs a source.
