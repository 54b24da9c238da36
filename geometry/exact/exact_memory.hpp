#pragma once

namespace polynya::geometry {

/// Lets exact numbers outlast other memory: where there is none any more, the new-handler is called and they
/// go on in a reserve of their own, so that the next thing which is no number can throw std::bad_alloc. GMP
/// by itself ends the program, and a throw through it is no way out: mpz_mul() frees its result's limbs
/// before it asks for others. Call it before the first exact number.
void let_exact_numbers_outlast_memory();

}  // namespace polynya::geometry
