#include "dynamics/contact/cover_cache.hpp"

#include "dynamics/contact/broad_phase.hpp"

namespace polynya::dynamics {
namespace {

constexpr std::size_t kSecond = 32;  ///< a body's neighbours in a field, and some of the next one's

}  // namespace

std::pair<geometry::Covered, geometry::Covered> CoverCache::of(const Bodies& bodies, BodyIndex a, BodyIndex b,
                                                               const geometry::CircleRule& rule) {
  const geometry::Boundary& of_a = *bodies.boundary[a];
  const geometry::Boundary& of_b = *bodies.boundary[b];
  return {{of_a.edges, of_a.is_ready() ? *of_a.cover : first(of_a, a, rule)},
          {of_b.edges, of_b.is_ready() ? *of_b.cover : second(of_b, b, rule)}};
}

void CoverCache::clear() {
  first_ = {};
  second_ = std::vector<Entry>();
}

const geometry::Cover& CoverCache::first(const geometry::Boundary& boundary, BodyIndex body,
                                         const geometry::CircleRule& rule) {
  if (first_.body == body) return first_.cover;
  if (!second_.empty()) {  // pairs are ordered by their first body: most have been the second one before
    Entry& entry = second_[static_cast<std::size_t>(body) % kSecond];
    if (entry.body == body) {
      std::swap(first_, entry);
      return first_.cover;
    }
  }
  first_.body = -1;
  make_cover(boundary.edges, rule, first_.cover);
  first_.body = body;
  return first_.cover;
}

const geometry::Cover& CoverCache::second(const geometry::Boundary& boundary, BodyIndex body,
                                          const geometry::CircleRule& rule) {
  if (second_.empty()) second_.resize(kSecond);
  Entry& entry = second_[static_cast<std::size_t>(body) % kSecond];
  if (entry.body == body) return entry.cover;
  entry.body = -1;
  make_cover(boundary.edges, rule, entry.cover);
  entry.body = body;
  return entry.cover;
}

/// Makes and keeps the cover of a body that another comes near, unless those kept are many.
void BroadPhase::keep_cover(const Bodies& bodies, BodyIndex body) {
  geometry::Boundary& boundary = *bodies.boundary[body];
  if (boundary.is_ready()) return;
  const double pieces = pieces_of(boundary.edges, rule_.circle_radius);
  const bool is_cheap = pieces <= kManyPieces && !rule_.is_circle_centres;
  if (is_cheap && kept_pieces_ + pieces > rule_.most_kept_pieces) return;
  make_ready(boundary, {rule_.circle_radius, rule_.is_circle_centres});
  entries_[body].kept_pieces = static_cast<std::uint32_t>(boundary.cover->pieces.size());
  kept_pieces_ += entries_[body].kept_pieces;
}

}  // namespace polynya::dynamics
