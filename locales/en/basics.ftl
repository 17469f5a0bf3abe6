# Objectives of the basics: gates, places, hovering, formation, arming, landing.
mission-gates = { $count ->
    [one] { $count } gate
   *[other] { $count } gates
}
mission-gates-of = { $passed }/{ $count } gates
mission-gates-advice = Fly through { $gate } next: pass within { $radius } m of its centre, and fly the gates in order.
mission-visit = { $count ->
    [one] { $count } place
   *[other] { $count } places
}
mission-visit-of = { $passed }/{ $count } places
mission-visit-advice = Also visit { $place }: stay within { $radius } m of it for { $dwell } s.
mission-hover = { $time } s
mission-hover-of = { $held }/{ $time } s
mission-hover-advice-at = Hover for { $time } s without interruption, within { $radius } m of { $place }, at a height of { $low } to { $high } m.
mission-hover-advice = Hover for { $time } s without interruption, within { $radius } m of one point, at a height of { $low } to { $high } m.
mission-formation = { $count ->
    [one] { $count } gate, { $percent } %
   *[other] { $count } gates, { $percent } %
}
mission-formation-of = { $passed }/{ $count } gates, { $percent } %
mission-formation-advice = Lead the centre of the swarm through { $gate }; keep each drone { $low } to { $high } m from its nearest neighbour all the way.
mission-arm-within = { $time } s
mission-armed-after = armed after { $time } s
mission-not-armed = not armed
mission-arm-advice = Arm within { $time } s after the drone is ready: `wait all ready`, then `arm`.
mission-land-within = { $radius } m
mission-landed-of = { $down }/{ $count } landed
mission-land-advice = Land within { $radius } m of { $place } and wait until the drone disarms.
