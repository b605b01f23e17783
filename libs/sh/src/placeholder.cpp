namespace ssphh {}
