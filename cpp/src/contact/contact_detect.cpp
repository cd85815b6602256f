/// What the responses of explicit steps read of contacts: where these are, and how fast they close.

#include "hold_back.h"
#include "push_ahead.h"
#include "tissu/contact/candidates.h"
#include "tissu/contact/contact_run.h"

namespace tissu {

void ContactRun::detect(const State& at, const State* goal) {
  looked_at_ = &at;
  gather(at, now_);
  plainly_ = goal == nullptr;
  if (goal != nullptr) {
    goal_.resize(now_.size());
    gather(*goal, goal_);
    // What a led obstacle pushed is looked at where it was pushed to.
    const auto& vertices = contact_.surfaces().vertices();
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (!vertices[v].is_free()) continue;
      for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) now_[i] += from_[i] - begin_[i];
    }
  }
  near().cover(from_, now_);
  find();
  keep_multipliers();
  hand_over();
}

Vec3 ContactRun::led(const ContactNumbers& contact) const {
  Vec3 gone = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    if (contact.vertex[k] < 0.0) continue;
    const auto v = static_cast<std::int32_t>(contact.vertex[k]);
    if (contact_.surfaces().vertices()[static_cast<std::size_t>(v)].is_free()) continue;
    gone += contact.beta[k] * (block(ConstReals(from_), v) - block(ConstReals(begin_), v));
  }
  if (contact.kind == ContactNumbers::kPlane) {
    const Vec3 point = -vector_of(contact.fixed);
    gone -=
        point - contact_.carried(static_cast<std::int32_t>(contact.b), point, *start_, end_, start_->time);
  }
  if (turns_led_) gone += turned_by(contact);
  return gone;
}

Vec3 ContactRun::rate(const ContactNumbers& contact, ConstReals velocities) const {
  return contact_.motion(contact, *start_, velocities);
}

Vec3 ContactRun::gone(const ContactNumbers& contact, const State& at) const {
  const double share = (at.time - start_->time) / (end_ - start_->time);
  return share * led(contact) + contact_.reach(contact, at) - contact_.reach(contact, *start_);
}

}  // namespace tissu
