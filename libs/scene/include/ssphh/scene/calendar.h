#pragma once

namespace ssphh::scene {

/// The days of a month of the Gregorian calendar. Throws Error for a month beside 1 to 12.
int days_of_month(int year, int month);

}  // namespace ssphh::scene
