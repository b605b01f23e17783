#pragma once

namespace ssphh::scene {

/// The days of a month of the Gregorian calendar; `month` from 1 to 12.
int days_of_month(int year, int month);

}  // namespace ssphh::scene
