#pragma once

namespace ssphh::scene {

/// Of the Gregorian calendar; `month` from 1 to 12.
int days_of_month(int year, int month);

}  // namespace ssphh::scene
