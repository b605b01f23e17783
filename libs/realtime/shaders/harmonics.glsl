
// Visits Y_lm(d) for l <= degree in the order m = 0, 1, ...; BODY uses k and y.
#define FOR_EACH_HARMONIC(degree, d, BODY)                                        \
  {                                                                               \
    vec2 power_ = vec2(1, 0);                                                     \
    float sectoral_ = 0.28209479177;                                              \
    for (int m_ = 0; m_ <= (degree); ++m_) {                                      \
      float before_ = 0, now_ = sectoral_, scale_before_ = 0;                     \
      for (int l_ = m_; l_ <= (degree); ++l_) {                                   \
        int k = l_ * (l_ + 1) + m_;                                               \
        float y = now_ * power_.x * (m_ > 0 ? 1.41421356237 : 1.0);               \
        int l = l_;                                                               \
        BODY;                                                                     \
        if (m_ > 0) {                                                             \
          k = l_ * (l_ + 1) - m_;                                                 \
          y = now_ * power_.y * 1.41421356237;                                    \
          BODY;                                                                   \
        }                                                                         \
        float n_ = float(l_ + 1), mm_ = float(m_ * m_);                           \
        float a_ = sqrt((4 * n_ * n_ - 1) / (n_ * n_ - mm_));                     \
        float next_ = a_ * ((d).z * now_ - scale_before_ * before_);              \
        scale_before_ = 1 / a_;                                                   \
        before_ = now_;                                                           \
        now_ = next_;                                                             \
      }                                                                           \
      float q_ = float(2 * m_ + 3) / float(2 * m_ + 2);                           \
      sectoral_ *= sqrt(q_);                                                      \
      power_ = vec2((d).x * power_.x - (d).y * power_.y, (d).x * power_.y + (d).y * power_.x); \
    }                                                                             \
  }
