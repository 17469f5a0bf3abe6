# Помилки у файлах налаштувань, клавіш і тем.

config-unknown = немає налаштування `{ $name }`
config-wrong = для `{ $name }` потрібно { $expected }
config-wrong-word = для { $name } потрібно { $expected }, а не `{ $word }`
config-section = `{ $name }` — це розділ: напишіть [{ $name }] окремим рядком, а його налаштування нижче
config-expected-word = одне зі слів: { $choices }
config-expected-text = текст у лапках
config-expected-number = ціле число від { $least } до { $most }
config-expected-flag = true або false
config-expected-words = список слів, наприклад ["one", "two"]
config-expected-lines = рядок мови команд у лапках або список таких рядків
