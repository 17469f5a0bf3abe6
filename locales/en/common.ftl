# Words used by several files.

count-vehicles = { $count ->
    [one] { $count } vehicle
   *[other] { $count } vehicles
}
common-more = ... { $count } more
