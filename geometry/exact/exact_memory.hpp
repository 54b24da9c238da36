#pragma once

namespace polynya::geometry {

/// Lets exact numbers outlast other memory: where allocation fails, GMP calls the new-handler and continues
/// in a reserve of its own, so that the next other allocation throws std::bad_alloc. GMP by itself ends the
/// program, and must not be thrown through: mpz_mul() frees its result's limbs before it allocates others.
/// Call it before the first exact number.
void let_exact_numbers_outlast_memory();

}  // namespace polynya::geometry
