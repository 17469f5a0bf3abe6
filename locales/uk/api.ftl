# Інтерфейс для програм

api-no-json = рядок не є JSON: { $error }
api-no-object = рядок не є об'єктом JSON
api-bad-id = `id` має бути цілим невід'ємним числом
api-bad-request = хибний запит: { $error }
api-bad-interval = `every_s` має бути від { $least } до { $most }
api-which-vehicle = вкажіть апарат: "vehicle": 1
api-too-long = рядок довший за { $most } байтів
api-not-utf8 = рядок не в кодуванні UTF-8
api-read-only = цей сокет лише для читання: щоб давати команди, запустіть консоль з --api
api-exam = під час іспиту програми не можуть давати команди
api-screen = цей рядок лише для екрана
api-no-macro = надсилайте рядки макросу по одному
api-asks = ця команда потребує підтвердження
api-commands = програма дає команди через { $socket }
api-in-use = { $socket } уже використовує інша консоль: виберіть інший шлях
api-no-socket = { $socket } існує і не є сокетом: виберіть інший шлях або видаліть файл
api-not-open = не вдалося відкрити сокет { $socket }: { $error }
