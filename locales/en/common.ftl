# Words that several subjects share.

count-vehicles = { $count ->
    [one] { $count } vehicle
   *[other] { $count } vehicles
}
