# Слова, спільні для кількох розділів.

count-vehicles = { $count ->
    [one] { $count } апарат
    [few] { $count } апарати
   *[many] { $count } апаратів
}
